# =================================================================================================
# Section 4: transient growth, pseudospectra and sensitivity, Figure 4.3
# =================================================================================================


PSEUDO = config["pseudospectrum"]["fig_pseudospectrum"]


rule compute_transient:
    """Section 4: norm of exp(-t M), one geometry of an entry of `transient`."""
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
    message:
        "compute_transient/{wildcards.figure}/{wildcards.geometry}: Section 4: norm of exp(-tM)"
    script:
        f"{SCRIPTS}/compute_transient.py"


rule compute_pseudospectrum:
    """Section 4: sigma_min(z I - M) over the plane."""
    input:
        code=code_of("compute_pseudospectrum"),
    output:
        artifact="results/pseudospectrum/{figure}/{geometry}_{formulation}.nc",
        provenance="results/pseudospectrum/{figure}/{geometry}_{formulation}.provenance.json",
    log:
        "logs/compute_pseudospectrum/{figure}_{geometry}_{formulation}.log",
    benchmark:
        "logs/compute_pseudospectrum/{figure}_{geometry}_{formulation}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["pseudospectrum"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hopper=lambda wildcards: spectrum_case(
            pseudospectrum("spectrum")(wildcards), wildcards.geometry
        ),
        nodes=lambda wildcards: config["spectra"][pseudospectrum("spectrum")(wildcards)]["nodes"],
        formulation="{formulation}",
        norm=weighting("norm"),
        psi_scale=weighting("psi_scale"),
        real=pseudospectrum("real"),
        imag=pseudospectrum("imag"),
    message:
        "compute_pseudospectrum/{wildcards.figure}/{wildcards.geometry}/{wildcards.formulation}: Section 4: sigma_min(z I - M) over the plane"
    script:
        f"{SCRIPTS}/compute_pseudospectrum.py"


rule compute_sensitivity:
    """Section 4: resolvent, condition numbers, distance to instability."""
    input:
        spectrum=f"results/spectrum/{PSEUDO['spectrum']}/{{geometry}}.nc",
        code=code_of("compute_sensitivity"),
    output:
        artifact="results/sensitivity/{geometry}_{formulation}.nc",
        provenance="results/sensitivity/{geometry}_{formulation}.provenance.json",
    log:
        "logs/compute_sensitivity/{geometry}_{formulation}.log",
    benchmark:
        "logs/compute_sensitivity/{geometry}_{formulation}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hopper=lambda wildcards: spectrum_case(PSEUDO["spectrum"], wildcards.geometry),
        nodes=config["spectra"][PSEUDO["spectrum"]]["nodes"],
        formulation="{formulation}",
        norm=lambda wildcards: PSEUDO["formulations"][wildcards.formulation]["norm"],
        psi_scale=lambda wildcards: PSEUDO["formulations"][wildcards.formulation]["psi_scale"],
        frequencies=config["sensitivity"]["frequencies"],
        elapsed=config["sensitivity"]["elapsed"],
    message:
        "compute_sensitivity/{wildcards.geometry}/{wildcards.formulation}: Section 4: resolvent, condition numbers, distance to instability"
    script:
        f"{SCRIPTS}/compute_sensitivity.py"


rule plot_fig_4_3:
    """Figure 4.3, and other entries of `transient`: one norm and its bounds."""
    input:
        wedge="results/transient/{figure}/wedge.nc",
        cone="results/transient/{figure}/cone.nc",
        code=code_of("plot_fig_4_3"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_4_3.rst",
            category="4 Stability",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "norm of exp(−tM)",
                "wedge, cone",
                kept_in(wildcards),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_4_3/{figure}.log",
    benchmark:
        "logs/plot_fig_4_3/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(entries.of_kind(config, "bounds")),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_4_3/{wildcards.figure}: figure of growth between its bounds"
    script:
        f"{SCRIPTS}/plot_fig_4_3.py"


rule plot_fig_4_3_norms:
    """Entries of `transient` with several norms."""
    input:
        wedge="results/transient/{figure}/wedge.nc",
        cone="results/transient/{figure}/cone.nc",
        code=code_of("plot_fig_4_3_norms"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_4_3_norms.rst",
            category="4 Stability",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "growth in several norms",
                "wedge, cone",
                kept_in(wildcards),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_4_3_norms/{figure}.log",
    benchmark:
        "logs/plot_fig_4_3_norms/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(entries.of_kind(config, "norms")),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_4_3_norms/{wildcards.figure}: figure of growth in several norms"
    script:
        f"{SCRIPTS}/plot_fig_4_3_norms.py"


rule plot_fig_pseudospectrum:
    """Each entry of `pseudospectrum`."""
    input:
        panels=lambda wildcards: expand(
            "results/pseudospectrum/{figure}/{geometry}_{formulation}.nc",
            figure=wildcards.figure,
            formulation=formulations(wildcards),
            geometry=["wedge", "cone"],
        ),
        spectra=lambda wildcards: expand(
            "results/spectrum/{spectrum}/{geometry}.nc",
            spectrum=pseudospectrum("spectrum")(wildcards),
            geometry=["wedge", "cone"],
        ),
        code=code_of("plot_fig_pseudospectrum"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_pseudospectrum.rst",
            category="4 Stability",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "least singular value of zI − M",
                "wedge, cone",
                " and ".join(formulations(wildcards)),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_pseudospectrum/{figure}.log",
    benchmark:
        "logs/plot_fig_pseudospectrum/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["pseudospectrum"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        levels_log10=pseudospectrum("levels_log10"),
        formulations=formulations,
        norms=lambda wildcards: [
            pseudospectrum("formulations")(wildcards)[each]["norm"]
            for each in formulations(wildcards)
        ],
    message:
        "plot_fig_pseudospectrum/{wildcards.figure}: figure of pseudospectra"
    script:
        f"{SCRIPTS}/plot_fig_pseudospectrum.py"


rule plot_fig_resolvent:
    """Resolvent on the imaginary axis, and the Kreiss bound."""
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
            labels=labels(
                "resolvent", "resolvent and Kreiss bound", "wedge, cone", "paper and physical"
            ),
        ),
        pdf="figures/fig_resolvent.pdf",
    log:
        "logs/plot_fig_resolvent.log",
    benchmark:
        "logs/plot_fig_resolvent.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_resolvent: Resolvent on the imaginary axis, and the Kreiss bound"
    script:
        f"{SCRIPTS}/plot_fig_resolvent.py"
