# =================================================================================================
# Hoppers of one's own: the list `cases` of the configuration
# =================================================================================================

FIGURES += [f"case_{case['name']}" for case in config["cases"]]


rule compute_case:
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
    script:
        f"{SCRIPTS}/compute_case.py"


rule plot_case:
    input:
        artifact="results/cases/{case}.nc",
        code=code_of("plot_case"),
    output:
        png=report(
            "figures/case_{case}.png",
            caption="../report/case.rst",
            category="Cases",
            labels={"case": "{case}"},
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
        description=lambda wildcards: own_hopper(wildcards).get("description", ""),
        delta_deg=lambda wildcards: own_hopper(wildcards)["delta_deg"],
    script:
        f"{SCRIPTS}/plot_case.py"
