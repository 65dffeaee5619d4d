# =================================================================================================
# Validation: flow factors against Jenike's published chart
# =================================================================================================


rule compute_flow_factor:
    """Section 3: flow factors beside Jenike's published chart."""
    input:
        chart=code_graph.relative(ROOT / "resources/jenike_chart_delta40.csv"),
        code=code_of("compute_flow_factor"),
    output:
        artifact="results/flow_factor/jenike.nc",
        provenance="results/flow_factor/jenike.provenance.json",
    log:
        "logs/compute_flow_factor.log",
    benchmark:
        "logs/compute_flow_factor.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        **config["fig_jenike"],
    message:
        "compute_flow_factor: Section 3: flow factors beside Jenike's published chart"
    script:
        f"{SCRIPTS}/compute_flow_factor.py"


rule plot_fig_jenike:
    """Flow factors, computed and published."""
    input:
        artifact="results/flow_factor/jenike.nc",
        code=code_of("plot_fig_jenike"),
    output:
        png=report(
            "figures/fig_jenike.png",
            caption="../report/fig_jenike.rst",
            category="3 Radial solutions",
            labels=labels("Jenike", "flow factors against published charts", "wedge, cone"),
        ),
        pdf="figures/fig_jenike.pdf",
    log:
        "logs/plot_fig_jenike.log",
    benchmark:
        "logs/plot_fig_jenike.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_jenike: Flow factors, computed and published"
    script:
        f"{SCRIPTS}/plot_fig_jenike.py"
