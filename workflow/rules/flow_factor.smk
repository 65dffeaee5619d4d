# =================================================================================================
# Validation: flow factors against Jenike's published chart
# =================================================================================================

FIGURES += ["fig_jenike"]


rule compute_flow_factor:
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
    script:
        f"{SCRIPTS}/compute_flow_factor.py"


rule plot_fig_jenike:
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
    script:
        f"{SCRIPTS}/plot_fig_jenike.py"
