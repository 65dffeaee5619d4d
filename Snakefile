"""Gremaud, Matthews, Shearer (2000): every figure of the paper, from its equations.

Targets: `snakemake` makes all figures and the claims ledger, `snakemake paper` the figures of the
paper, `snakemake figures/fig_3_1.png` or `snakemake results/claims.html` one of them.
"""


include: "workflow/rules/root.smk"
include: "workflow/rules/configfile.smk"


configfile: "config.yaml"


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/parameters.smk"
include: "workflow/rules/geometry.smk"
include: "workflow/rules/radial.smk"
include: "workflow/rules/flow_factor.smk"
include: "workflow/rules/design.smk"
include: "workflow/rules/spectrum.smk"
include: "workflow/rules/transient.smk"
include: "workflow/rules/domain.smk"
include: "workflow/rules/von_mises.smk"
include: "workflow/rules/march.smk"
include: "workflow/rules/cases.smk"
include: "workflow/rules/claims.smk"


rule all:
    """All figures and the claims ledger."""
    default_target: True
    input:
        expand("figures/{figure}.{suffix}", figure=FIGURES, suffix=["png", "pdf"]),
        LEDGER,
        ["results/cases.csv"] if config["cases"] else [],


rule paper:
    """The figures of the paper, with the sound curves beside its own."""
    input:
        expand("figures/{figure}.{suffix}", figure=PAPER, suffix=["png", "pdf"]),


# Of one's own command line only: a host of this workflow has other targets.
if not workflow.modifier.skip_configfile:
    outputs = [str(file) for rule in workflow.rules for file in rule.output]
    if problem := targets.missing(sys.argv[1:], outputs):
        raise WorkflowError(problem)


# Snakemake puts the folders of a module's files first on the path of its host.
sys.path[:] = [folder for folder in sys.path if folder not in {str(ROOT), str(HERE)}]
