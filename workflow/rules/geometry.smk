# =================================================================================================
# Figure 1.1: geometry and coordinates
# =================================================================================================


rule plot_fig_1_1:
    """Figure 1.1, the two geometries."""
    input:
        code=code_of("plot_fig_1_1"),
    output:
        png=report(
            "figures/fig_1_1.png",
            caption="../report/fig_1_1.rst",
            category="1 Introduction",
            labels=labels("1.1", "geometry and coordinates", "wedge, cone"),
        ),
        pdf="figures/fig_1_1.pdf",
    log:
        "logs/plot_fig_1_1.log",
    benchmark:
        "logs/plot_fig_1_1.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        **config["fig_1_1"],
    message:
        "plot_fig_1_1: Figure 1.1, the two geometries"
    script:
        f"{SCRIPTS}/plot_fig_1_1.py"
