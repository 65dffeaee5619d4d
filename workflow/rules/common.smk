# =================================================================================================
# Common: configuration check, and the code each rule depends on
# =================================================================================================

try:
    configuration.check(config, SCHEMA)
except configuration.ConfigurationError as error:
    raise WorkflowError(str(error)) from None
for line in configuration.bring_up_to_date(config, SCHEMA):
    logger.warning(line)

FIGURES = []
COSTS = requests.read_costs(ROOT / "resources/benchmarks.tsv")


wildcard_constraints:
    figure=r"fig_\w+",
    geometry="wedge|cone",
    nodes=r"\d+",
    mode="paper|physical",
    angle=r"[0-9.]+",
    chunk=r"\d+",
    case="[a-z][a-z0-9_]*",


def code_of(script):
    """Modules a script imports, directly or not. Inputs, so that editing one reruns its users."""
    return code_graph.modules_used_by(ROOT, f"scripts/{script}.py")


def asks(rule, points):
    """Run time and memory of a job with this many points of a map; another attempt asks for more."""
    return {
        name: lambda wildcards, attempt, value=value: attempt * value
        for name, value in requests.of_job(COSTS[rule], points).items()
    }
