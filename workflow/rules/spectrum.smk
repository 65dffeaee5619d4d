# =================================================================================================
# Section 4: smooth-wall theory, discrete spectra and their filter, Figures 4.1 and 4.2
# =================================================================================================

FIGURES += ["fig_4_1", "fig_4_2", "fig_4_2_physical"]


rule compute_spectrum:
    input:
        code=code_of("compute_spectrum"),
    output:
        artifact="results/spectrum/{figure}/{geometry}_{nodes}.nc",
        provenance="results/spectrum/{figure}/{geometry}_{nodes}.provenance.json",
    log:
        "logs/compute_spectrum/{figure}_{geometry}_{nodes}.log",
    benchmark:
        "logs/compute_spectrum/{figure}_{geometry}_{nodes}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["spectra"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="{geometry}",
        delta_deg=lambda wildcards: hopper_of(wildcards.figure)["delta_deg"],
        half_angle_deg=lambda wildcards: hopper_of(wildcards.figure)["half_angle_deg"],
        mu=lambda wildcards: hopper_of(wildcards.figure)["mu"],
        nodes=lambda wildcards: int(wildcards.nodes),
    script:
        f"{SCRIPTS}/compute_spectrum.py"


rule filter_spectrum:
    input:
        fine=mesh("nodes"),
        coarse=mesh("coarse_nodes"),
        code=code_of("filter_spectrum"),
    output:
        artifact="results/spectrum/{figure}/{geometry}.nc",
        provenance="results/spectrum/{figure}/{geometry}.provenance.json",
    log:
        "logs/filter_spectrum/{figure}_{geometry}.log",
    benchmark:
        "logs/filter_spectrum/{figure}_{geometry}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["spectra"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="{geometry}",
        delta_deg=lambda wildcards: hopper_of(wildcards.figure)["delta_deg"],
        half_angle_deg=lambda wildcards: hopper_of(wildcards.figure)["half_angle_deg"],
        mu=lambda wildcards: hopper_of(wildcards.figure)["mu"],
        nodes=lambda wildcards: config["spectra"][wildcards.figure]["nodes"],
        coarse_nodes=lambda wildcards: config["spectra"][wildcards.figure]["coarse_nodes"],
        tolerance=lambda wildcards: config["spectra"][wildcards.figure]["tolerance"],
    script:
        f"{SCRIPTS}/filter_spectrum.py"


rule compute_exact_spectrum:
    input:
        code=code_of("compute_exact_spectrum"),
    output:
        artifact="results/spectrum/{figure}/{geometry}_exact.nc",
        provenance="results/spectrum/{figure}/{geometry}_exact.provenance.json",
    log:
        "logs/compute_exact_spectrum/{figure}_{geometry}.log",
    benchmark:
        "logs/compute_exact_spectrum/{figure}_{geometry}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["spectra"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="{geometry}",
        delta_deg=lambda wildcards: hopper_of(wildcards.figure)["delta_deg"],
        half_angle_deg=lambda wildcards: hopper_of(wildcards.figure)["half_angle_deg"],
        modes=lambda wildcards: config["spectra"][wildcards.figure]["exact_modes"],
    script:
        f"{SCRIPTS}/compute_exact_spectrum.py"


rule compute_stability:
    input:
        code=code_of("compute_stability"),
    output:
        artifact="results/stability/{figure}/{geometry}.nc",
        provenance="results/stability/{figure}/{geometry}.provenance.json",
    log:
        "logs/compute_stability/{figure}_{geometry}.log",
    benchmark:
        "logs/compute_stability/{figure}_{geometry}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["spectra"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="{geometry}",
        delta_deg=lambda wildcards: hopper_of(wildcards.figure)["delta_deg"],
        half_angle_deg=lambda wildcards: hopper_of(wildcards.figure)["half_angle_deg"],
        mu=lambda wildcards: hopper_of(wildcards.figure)["mu"],
    script:
        f"{SCRIPTS}/compute_stability.py"


rule compute_smooth_wall:
    input:
        code=code_of("compute_smooth_wall"),
    output:
        artifact="results/smooth_wall.nc",
        provenance="results/smooth_wall.provenance.json",
    log:
        "logs/compute_smooth_wall.log",
    benchmark:
        "logs/compute_smooth_wall.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        **config["smooth_wall"],
    script:
        f"{SCRIPTS}/compute_smooth_wall.py"


rule plot_fig_4_1:
    input:
        artifact="results/smooth_wall.nc",
        code=code_of("plot_fig_4_1"),
    output:
        png=report(
            "figures/fig_4_1.png",
            caption="../report/fig_4_1.rst",
            category="4 Stability",
            labels=labels("4.1", "smooth-wall abscissae", "wedge, cone", "exact"),
        ),
        pdf="figures/fig_4_1.pdf",
    log:
        "logs/plot_fig_4_1.log",
    benchmark:
        "logs/plot_fig_4_1.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    script:
        f"{SCRIPTS}/plot_fig_4_1.py"


rule plot_fig_4_2:
    input:
        wedge="results/spectrum/fig_4_2/wedge.nc",
        cone="results/spectrum/fig_4_2/cone.nc",
        wedge_exact="results/spectrum/fig_4_2/wedge_exact.nc",
        cone_exact="results/spectrum/fig_4_2/cone_exact.nc",
        code=code_of("plot_fig_4_2"),
    output:
        png=report(
            "figures/fig_4_2.png",
            caption="../report/fig_4_2.rst",
            category="4 Stability",
            labels=labels("4.2", "discrete spectra", "wedge, cone", "paper"),
        ),
        pdf="figures/fig_4_2.pdf",
    log:
        "logs/plot_fig_4_2.log",
    benchmark:
        "logs/plot_fig_4_2.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        zoom_imag=config["fig_4_2"]["zoom_imag"],
    script:
        f"{SCRIPTS}/plot_fig_4_2.py"


rule plot_fig_4_2_physical:
    input:
        wedge="results/spectrum/fig_4_2/wedge.nc",
        cone="results/spectrum/fig_4_2/cone.nc",
        wedge_line="results/stability/fig_4_2/wedge.nc",
        cone_line="results/stability/fig_4_2/cone.nc",
        code=code_of("plot_fig_4_2_physical"),
    output:
        png=report(
            "figures/fig_4_2_physical.png",
            caption="../report/fig_4_2_physical.rst",
            category="4 Stability",
            labels=labels("4.2 physical", "spectra and the line Λ", "wedge, cone", "physical"),
        ),
        pdf="figures/fig_4_2_physical.pdf",
    log:
        "logs/plot_fig_4_2_physical.log",
    benchmark:
        "logs/plot_fig_4_2_physical.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    script:
        f"{SCRIPTS}/plot_fig_4_2_physical.py"
