# =================================================================================================
# Section 4: transient growth, pseudospectra and sensitivity, Figure 4.3
# =================================================================================================

FIGURES += ["fig_4_3", "fig_4_3_norms", "fig_pseudospectrum", "fig_resolvent"]


PSEUDO = config["pseudospectrum"]


rule compute_transient:
    input:
        spectrum=lambda wildcards: f"results/spectrum/{transient('spectrum')(wildcards)}/{wildcards.geometry}.nc",
        code=code_of("compute_transient"),
    output:
        artifact="results/transient/{figure}/{geometry}.nc",
        provenance="results/transient/{figure}/{geometry}.provenance.json",
    log:
        "logs/compute_transient/{figure}_{geometry}.log",
    benchmark:
        "logs/compute_transient/{figure}_{geometry}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["transient"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hopper=lambda wildcards: spectrum_case(transient("spectrum")(wildcards), wildcards.geometry),
        nodes=lambda wildcards: config["spectra"][transient("spectrum")(wildcards)]["nodes"],
        kept_in=transient("kept_in"),
        norms=transient("norms"),
        psi_scales=transient("psi_scales"),
        elapsed=transient("elapsed"),
    script:
        f"{SCRIPTS}/compute_transient.py"


rule compute_pseudospectrum:
    input:
        code=code_of("compute_pseudospectrum"),
    output:
        artifact="results/pseudospectrum/{geometry}_{mode}.nc",
        provenance="results/pseudospectrum/{geometry}_{mode}.provenance.json",
    log:
        "logs/compute_pseudospectrum/{geometry}_{mode}.log",
    benchmark:
        "logs/compute_pseudospectrum/{geometry}_{mode}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hopper=lambda wildcards: spectrum_case(PSEUDO["spectrum"], wildcards.geometry),
        nodes=config["spectra"][PSEUDO["spectrum"]]["nodes"],
        mode="{mode}",
        norm=lambda wildcards: PSEUDO["modes"][wildcards.mode]["norm"],
        psi_scale=lambda wildcards: PSEUDO["modes"][wildcards.mode]["psi_scale"],
        real=PSEUDO["real"],
        imag=PSEUDO["imag"],
    script:
        f"{SCRIPTS}/compute_pseudospectrum.py"


rule compute_sensitivity:
    input:
        spectrum=f"results/spectrum/{PSEUDO['spectrum']}/{{geometry}}.nc",
        code=code_of("compute_sensitivity"),
    output:
        artifact="results/sensitivity/{geometry}_{mode}.nc",
        provenance="results/sensitivity/{geometry}_{mode}.provenance.json",
    log:
        "logs/compute_sensitivity/{geometry}_{mode}.log",
    benchmark:
        "logs/compute_sensitivity/{geometry}_{mode}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hopper=lambda wildcards: spectrum_case(PSEUDO["spectrum"], wildcards.geometry),
        nodes=config["spectra"][PSEUDO["spectrum"]]["nodes"],
        mode="{mode}",
        norm=lambda wildcards: PSEUDO["modes"][wildcards.mode]["norm"],
        psi_scale=lambda wildcards: PSEUDO["modes"][wildcards.mode]["psi_scale"],
        frequencies=config["sensitivity"]["frequencies"],
        elapsed=config["sensitivity"]["elapsed"],
    script:
        f"{SCRIPTS}/compute_sensitivity.py"


rule plot_fig_4_3:
    input:
        wedge="results/transient/fig_4_3/wedge.nc",
        cone="results/transient/fig_4_3/cone.nc",
        code=code_of("plot_fig_4_3"),
    output:
        png=report(
            "figures/fig_4_3.png",
            caption="../report/fig_4_3.rst",
            category="4 Stability",
            labels=labels("4.3", "norm of exp(−tM)", "wedge, cone", "paper"),
        ),
        pdf="figures/fig_4_3.pdf",
    log:
        "logs/plot_fig_4_3.log",
    benchmark:
        "logs/plot_fig_4_3.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    script:
        f"{SCRIPTS}/plot_fig_4_3.py"


rule plot_fig_4_3_norms:
    input:
        wedge="results/transient/fig_4_3_norms/wedge.nc",
        cone="results/transient/fig_4_3_norms/cone.nc",
        code=code_of("plot_fig_4_3_norms"),
    output:
        png=report(
            "figures/fig_4_3_norms.png",
            caption="../report/fig_4_3_norms.rst",
            category="4 Stability",
            labels=labels("4.3 norms", "growth in four norms", "wedge, cone", "both"),
        ),
        pdf="figures/fig_4_3_norms.pdf",
    log:
        "logs/plot_fig_4_3_norms.log",
    benchmark:
        "logs/plot_fig_4_3_norms.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    script:
        f"{SCRIPTS}/plot_fig_4_3_norms.py"


rule plot_fig_pseudospectrum:
    input:
        wedge_paper="results/pseudospectrum/wedge_paper.nc",
        cone_paper="results/pseudospectrum/cone_paper.nc",
        wedge_physical="results/pseudospectrum/wedge_physical.nc",
        cone_physical="results/pseudospectrum/cone_physical.nc",
        code=code_of("plot_fig_pseudospectrum"),
    output:
        png=report(
            "figures/fig_pseudospectrum.png",
            caption="../report/fig_pseudospectrum.rst",
            category="4 Stability",
            labels=labels(
                "pseudospectra", "least singular value of zI − M", "wedge, cone", "both"
            ),
        ),
        pdf="figures/fig_pseudospectrum.pdf",
    log:
        "logs/plot_fig_pseudospectrum.log",
    benchmark:
        "logs/plot_fig_pseudospectrum.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        levels_log10=PSEUDO["levels_log10"],
        norms={mode: PSEUDO["modes"][mode]["norm"] for mode in PSEUDO["modes"]},
    script:
        f"{SCRIPTS}/plot_fig_pseudospectrum.py"


rule plot_fig_resolvent:
    input:
        wedge_paper="results/sensitivity/wedge_paper.nc",
        cone_paper="results/sensitivity/cone_paper.nc",
        wedge_physical="results/sensitivity/wedge_physical.nc",
        cone_physical="results/sensitivity/cone_physical.nc",
        code=code_of("plot_fig_resolvent"),
    output:
        png=report(
            "figures/fig_resolvent.png",
            caption="../report/fig_resolvent.rst",
            category="4 Stability",
            labels=labels("resolvent", "resolvent and Kreiss bound", "wedge, cone", "both"),
        ),
        pdf="figures/fig_resolvent.pdf",
    log:
        "logs/plot_fig_resolvent.log",
    benchmark:
        "logs/plot_fig_resolvent.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    script:
        f"{SCRIPTS}/plot_fig_resolvent.py"
