# =================================================================================================
# Section 3: radial stress and velocity fields, Figures 3.1 and 3.2
# =================================================================================================


rule solve_radial:
    """Section 3: stress and velocity fields of an entry of `radial`."""
    input:
        code=code_of("solve_radial"),
    output:
        artifact="results/radial/{figure}.nc",
        provenance="results/radial/{figure}.provenance.json",
    log:
        "logs/solve_radial/{figure}.log",
    benchmark:
        "logs/solve_radial/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["radial"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry=radial("geometry"),
        delta_deg=radial("delta_deg"),
        half_angle_deg=radial("half_angle_deg"),
        models=radial("models"),
        mu=radial("mu"),
        points=radial("points"),
    message:
        "solve_radial/{wildcards.figure}: Section 3: stress and velocity fields of an entry of radial"
    script:
        f"{SCRIPTS}/solve_radial.py"


rule plot_fig_3_1:
    """Figure 3.1, and other entries of `radial`: stress and velocity."""
    input:
        artifact="results/radial/{figure}.nc",
        code=code_of("plot_fig_3_1"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_3_1.rst",
            category="3 Radial solutions",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "stress and velocity",
                radial("geometry")(wildcards),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_3_1/{figure}.log",
    benchmark:
        "logs/plot_fig_3_1/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(entries.of_kind(config, "stress_and_velocity")),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_3_1/{wildcards.figure}: figure of stress and velocity"
    script:
        f"{SCRIPTS}/plot_fig_3_1.py"


rule plot_fig_3_2:
    """Figure 3.2, and other entries of `radial`: velocity and psi."""
    input:
        artifact="results/radial/{figure}.nc",
        code=code_of("plot_fig_3_2"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_3_2.rst",
            category="3 Radial solutions",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "velocity and angle ψ",
                radial("geometry")(wildcards),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_3_2/{figure}.log",
    benchmark:
        "logs/plot_fig_3_2/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(entries.of_kind(config, "velocity_and_psi")),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        # Where the paper sees it, in its own figure.
        stagnant_from_deg=lambda wildcards: (
            config["fig_3_2"]["stagnant_from_deg"] if wildcards.figure == "fig_3_2" else None
        ),
    message:
        "plot_fig_3_2/{wildcards.figure}: figure of velocity and psi"
    script:
        f"{SCRIPTS}/plot_fig_3_2.py"
