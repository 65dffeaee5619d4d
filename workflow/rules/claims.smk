# =================================================================================================
# The verdict: what the paper claims, held against the artifacts
# =================================================================================================

TEMPLATES = {
    kind: code_graph.relative(ROOT / f"workflow/report/claims.{kind}.j2") for kind in ["html", "md"]
}
LEDGER = ["results/claims.csv", "results/claims.html"]
HOPPER = config["radial"]["fig_3_2"]
LINEAR = config["claims"]["linear"]


rule compute_model_checks:
    """Sections 2 and 3: what only the ledger needs of the two models."""
    input:
        code=code_of("compute_model_checks"),
    output:
        artifact="results/checks/models.nc",
        provenance="results/checks/models.provenance.json",
    log:
        "logs/compute_model_checks.log",
    benchmark:
        "logs/compute_model_checks.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        **config["claims"]["models"],
        geometry=HOPPER["geometry"],
        delta_deg=HOPPER["delta_deg"],
        half_angle_deg=HOPPER["half_angle_deg"],
        models=HOPPER["models"],
        mu=sorted(
            {mu for figure in ["fig_3_1", "fig_3_2"] for mu in config["radial"][figure]["mu"]}
        ),
    message:
        "compute_model_checks: Sections 2 and 3: what only the ledger needs of the two models"
    script:
        f"{SCRIPTS}/compute_model_checks.py"


rule compute_linear_checks:
    """Section 4: what only the ledger needs of the linearised equations."""
    input:
        wedge=f"results/spectrum/{LINEAR['spectrum']}/wedge.nc",
        cone=f"results/spectrum/{LINEAR['spectrum']}/cone.nc",
        code=code_of("compute_linear_checks"),
    output:
        artifact="results/checks/linear.nc",
        provenance="results/checks/linear.provenance.json",
    log:
        "logs/compute_linear_checks.log",
    benchmark:
        "logs/compute_linear_checks.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        **hopper_of(LINEAR["spectrum"]),
        **mesh_of(LINEAR["spectrum"]),
        printed_at=LINEAR["printed_at"],
        smooth=LINEAR["smooth"],
        folds=LINEAR["folds"],
        windows=LINEAR["windows"],
        norms=PSEUDO["formulations"],
    message:
        "compute_linear_checks: Section 4: what only the ledger needs of the linearised equations"
    script:
        f"{SCRIPTS}/compute_linear_checks.py"


rule judge_claims:
    """The verdict on every claim of the paper."""
    input:
        claims=CLAIMS,
        schema=CLAIMS_SCHEMA,
        paths=JUDGED,
        code=code_of("judge_claims"),
    output:
        table="results/claims.csv",
    log:
        "logs/judge_claims.log",
    benchmark:
        "logs/judge_claims.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    resources:
        **asks("judge_claims", map_points()),
    message:
        "judge_claims: The verdict on every claim of the paper"
    script:
        f"{SCRIPTS}/judge_claims.py"


rule render_claims:
    """The ledger for reading, HTML and Markdown."""
    input:
        table="results/claims.csv",
        claims=CLAIMS,
        schema=CLAIMS_SCHEMA,
        html_template=TEMPLATES["html"],
        markdown_template=TEMPLATES["md"],
        code=code_of("render_claims"),
    output:
        html=report("results/claims.html", caption="../report/claims.rst", category="Claims"),
        markdown="results/claims.md",
    log:
        "logs/render_claims.log",
    benchmark:
        "logs/render_claims.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "render_claims: The ledger for reading, HTML and Markdown"
    script:
        f"{SCRIPTS}/render_claims.py"
