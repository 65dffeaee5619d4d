# =================================================================================================
# Section 4: smooth-wall theory, discrete spectra and their filter, Figures 4.1 and 4.2
# =================================================================================================


rule compute_spectrum:
    """Section 4: all eigenvalues of M on one mesh."""
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
    message:
        "compute_spectrum/{wildcards.figure}/{wildcards.geometry}/{wildcards.nodes}: Section 4: all eigenvalues of M on one mesh"
    script:
        f"{SCRIPTS}/compute_spectrum.py"


rule filter_spectrum:
    """Section 4: the eigenvalues that two meshes agree on."""
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
    message:
        "filter_spectrum/{wildcards.figure}/{wildcards.geometry}: Section 4: the eigenvalues that two meshes agree on"
    script:
        f"{SCRIPTS}/filter_spectrum.py"


rule compute_exact_spectrum:
    """Section 4: exact smooth-wall eigenvalues."""
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
    message:
        "compute_exact_spectrum/{wildcards.figure}/{wildcards.geometry}: Section 4: exact smooth-wall eigenvalues"
    script:
        f"{SCRIPTS}/compute_exact_spectrum.py"


rule compute_stability:
    """Section 4: low modes and the line, the verdict of stability."""
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
    message:
        "compute_stability/{wildcards.figure}/{wildcards.geometry}: Section 4: low modes and the line, the verdict of stability"
    script:
        f"{SCRIPTS}/compute_stability.py"


rule compute_smooth_wall:
    """Section 4: smooth-wall theory."""
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
    message:
        "compute_smooth_wall: Section 4: smooth-wall theory"
    script:
        f"{SCRIPTS}/compute_smooth_wall.py"


rule plot_fig_4_1:
    """Figure 4.1, abscissae of smooth walls."""
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
    message:
        "plot_fig_4_1: Figure 4.1, abscissae of smooth walls"
    script:
        f"{SCRIPTS}/plot_fig_4_1.py"


rule plot_fig_4_2:
    """Figure 4.2, and each other entry of `spectra`: the paper's formulation."""
    input:
        wedge="results/spectrum/{figure}/wedge.nc",
        cone="results/spectrum/{figure}/cone.nc",
        wedge_exact="results/spectrum/{figure}/wedge_exact.nc",
        cone_exact="results/spectrum/{figure}/cone_exact.nc",
        code=code_of("plot_fig_4_2"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_4_2.rst",
            category="4 Stability",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure), "discrete spectra", "wedge, cone", "paper"
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_4_2/{figure}.log",
    benchmark:
        "logs/plot_fig_4_2/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["spectra"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        zoom_imag=config["fig_4_2"]["zoom_imag"],
    message:
        "plot_fig_4_2/{wildcards.figure}: figure of a spectrum"
    script:
        f"{SCRIPTS}/plot_fig_4_2.py"


rule plot_fig_4_2_physical:
    """The same spectra in the physical formulation."""
    input:
        wedge="results/spectrum/{figure}/wedge.nc",
        cone="results/spectrum/{figure}/cone.nc",
        wedge_line="results/stability/{figure}/wedge.nc",
        cone_line="results/stability/{figure}/cone.nc",
        code=code_of("plot_fig_4_2_physical"),
    output:
        png=report(
            "figures/{figure}_physical.png",
            caption="../report/fig_4_2_physical.rst",
            category="4 Stability",
            labels=lambda wildcards: labels(
                f"{entries.number_of(wildcards.figure)} physical",
                "spectra and the line Λ",
                "wedge, cone",
                "physical",
            ),
        ),
        pdf="figures/{figure}_physical.pdf",
    log:
        "logs/plot_fig_4_2_physical/{figure}.log",
    benchmark:
        "logs/plot_fig_4_2_physical/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["spectra"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_4_2_physical/{wildcards.figure}: figure of a spectrum, physical formulation"
    script:
        f"{SCRIPTS}/plot_fig_4_2_physical.py"
