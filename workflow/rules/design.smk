# =================================================================================================
# Design charts: wall friction against half angle
# =================================================================================================


rule compute_design_chart:
    """Limits of wall friction over the half angle, and flow factors."""
    input:
        code=code_of("compute_design_chart"),
    output:
        artifact="results/design/{geometry}.nc",
        provenance="results/design/{geometry}.provenance.json",
    log:
        "logs/compute_design_chart/{geometry}.log",
    benchmark:
        "logs/compute_design_chart/{geometry}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="{geometry}",
        deltas_deg=config["design_charts"]["deltas_deg"],
        half_angles_deg=config["design_charts"]["half_angles_deg"],
        frictions=config["design_charts"]["frictions"],
    message:
        "compute_design_chart: Limits of wall friction over the half angle, {wildcards.geometry}"
    script:
        f"{SCRIPTS}/compute_design_chart.py"


rule plot_fig_design:
    """Design charts, wall friction against half angle."""
    input:
        artifact="results/design/{geometry}.nc",
        code=code_of("plot_fig_design"),
    output:
        png=report(
            "figures/fig_design_{geometry}.png",
            caption="../report/fig_design.rst",
            category="3 Radial solutions",
            labels=labels("design chart", "limits of wall friction, flow factors", "{geometry}"),
        ),
        pdf="figures/fig_design_{geometry}.pdf",
    log:
        "logs/plot_fig_design/{geometry}.log",
    benchmark:
        "logs/plot_fig_design/{geometry}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        flow_factors=config["design_charts"]["flow_factors"],
    message:
        "plot_fig_design: Design charts, {wildcards.geometry}"
    script:
        f"{SCRIPTS}/plot_fig_design.py"
