# =================================================================================================
# Section 3: radial stress and velocity fields, Figures 3.1 and 3.2
# =================================================================================================

FIGURES += ["fig_3_1", "fig_3_2"]


rule solve_radial:
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
        geometry=lambda wildcards: config["radial"][wildcards.figure]["geometry"],
        delta_deg=lambda wildcards: config["radial"][wildcards.figure]["delta_deg"],
        half_angle_deg=lambda wildcards: config["radial"][wildcards.figure]["half_angle_deg"],
        models=lambda wildcards: config["radial"][wildcards.figure]["models"],
        mu=lambda wildcards: config["radial"][wildcards.figure]["mu"],
        points=lambda wildcards: config["radial"][wildcards.figure]["points"],
    script:
        f"{SCRIPTS}/solve_radial.py"


rule plot_fig_3_1:
    input:
        artifact="results/radial/fig_3_1.nc",
        code=code_of("plot_fig_3_1"),
    output:
        png=report(
            "figures/fig_3_1.png",
            caption="../report/fig_3_1.rst",
            category="3 Radial solutions",
            labels=labels("3.1", "stress and velocity", "cone"),
        ),
        pdf="figures/fig_3_1.pdf",
    log:
        "logs/plot_fig_3_1.log",
    benchmark:
        "logs/plot_fig_3_1.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    script:
        f"{SCRIPTS}/plot_fig_3_1.py"


rule plot_fig_3_2:
    input:
        artifact="results/radial/fig_3_2.nc",
        code=code_of("plot_fig_3_2"),
    output:
        png=report(
            "figures/fig_3_2.png",
            caption="../report/fig_3_2.rst",
            category="3 Radial solutions",
            labels=labels("3.2", "velocity and angle ψ", "cone"),
        ),
        pdf="figures/fig_3_2.pdf",
    log:
        "logs/plot_fig_3_2.log",
    benchmark:
        "logs/plot_fig_3_2.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        stagnant_from_deg=config["fig_3_2"]["stagnant_from_deg"],
    script:
        f"{SCRIPTS}/plot_fig_3_2.py"
