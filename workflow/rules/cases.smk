# =================================================================================================
# Hoppers of one's own: the list `cases` of the configuration
# =================================================================================================


rule compute_case:
    """All that is known about a hopper of the list `cases`."""
    input:
        code=code_of("compute_case"),
    output:
        artifact="results/cases/{case}.nc",
        provenance="results/cases/{case}.provenance.json",
    log:
        "logs/compute_case/{case}.log",
    benchmark:
        "logs/compute_case/{case}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        case=lambda wildcards: {
            key: value for key, value in own_hopper(wildcards).items() if key != "description"
        },
    message:
        "compute_case/{wildcards.case}: All that is known about a hopper of the list cases"
    script:
        f"{SCRIPTS}/compute_case.py"


rule plot_case:
    """The page of a hopper of the list `cases`."""
    input:
        artifact="results/cases/{case}.nc",
        code=code_of("plot_case"),
    output:
        png=report(
            "figures/case_{case}.png",
            caption="../report/case.rst",
            category="Cases",
            labels=labels_of_case,
        ),
        pdf="figures/case_{case}.pdf",
    log:
        "logs/plot_case/{case}.log",
    benchmark:
        "logs/plot_case/{case}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        case=own_hopper,
        middle=lambda wildcards: own_hoppers.middle(own_hopper(wildcards)),
    message:
        "plot_case/{wildcards.case}: The page of a hopper of the list cases"
    script:
        f"{SCRIPTS}/plot_case.py"


rule summarise_cases:
    """All hoppers of the list `cases` in one table."""
    input:
        paths=[f"results/cases/{case['name']}.nc" for case in config["cases"]],
        code=code_of("summarise_cases"),
    output:
        table=report("results/cases.csv", caption="../report/cases.rst", category="Cases"),
    log:
        "logs/summarise_cases.log",
    benchmark:
        "logs/summarise_cases.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        cases=[
            {key: value for key, value in case.items() if key != "description"}
            for case in config["cases"]
        ],
    message:
        "summarise_cases: All hoppers of the list cases in one table"
    script:
        f"{SCRIPTS}/summarise_cases.py"
