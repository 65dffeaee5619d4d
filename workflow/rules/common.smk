# =================================================================================================
# Common: configuration check, and the code each rule depends on
# =================================================================================================

try:
    configuration.check(config, SCHEMA)
except configuration.ConfigurationError as error:
    raise WorkflowError(str(error)) from None
for line in configuration.bring_up_to_date(config, SCHEMA):
    logger.warning(line)

FIGURES = [drawing.figure for drawing in entries.drawings(config)]
# The paper's, each once, and what is needed to read them; others of its kinds are variations.
PAPER = [
    one
    for one in FIGURES
    if re.fullmatch(r"fig_(\d_\d|4_2_physical|4_3_norms|pseudospectrum)", one)
]
MAP = config["stability_map"]
VON_MISES = config["von_mises"]
FORMULATIONS = ["paper", "physical"]
COSTS = requests.read_costs(ROOT / "resources/benchmarks.tsv")


CLAIMS = code_graph.relative(ROOT / "resources/claims.yaml")
CLAIMS_SCHEMA = code_graph.relative(ROOT / "workflow/schemas/claims.schema.yaml")
try:
    JUDGED = paths_of(read_claims(CLAIMS, CLAIMS_SCHEMA))
except configuration.ConfigurationError as error:
    raise WorkflowError(str(error)) from None
# The ledger needs maps and borders of its own half angles, whatever the figures show.
LEDGER_ANGLES = half_angles_in(JUDGED)


# What the configuration does not name no rule makes; figures differ from rule to rule.
wildcard_constraints:
    geometry=targets.words(["wedge", "cone"]),
    nodes=targets.words(
        sorted(
            {
                case[mesh]
                for case in config["spectra"].values()
                for mesh in ["nodes", "coarse_nodes"]
            }
        )
    ),
    formulation=targets.words(FORMULATIONS),
    angle=targets.words(
        dict.fromkeys(
            [*map(str, MAP["half_angles_deg"] + VON_MISES["half_angles_deg"]), *LEDGER_ANGLES]
        )
    ),
    chunk=targets.words(range(max(MAP["chunks"], VON_MISES["map"]["chunks"]))),
    cone=targets.words(config["fig_vm_spectra"]["hoppers"]),
    case=targets.words(case["name"] for case in config["cases"]),


def code_of(script):
    """Modules a script imports, directly or not. Inputs, so that editing one reruns its users."""
    return code_graph.modules_used_by(ROOT, f"scripts/{script}.py")


def asks(rule, points):
    """Run time and memory of a job with this many points of a map; another attempt asks for more."""
    return {
        name: lambda wildcards, attempt, value=value: attempt * value
        for name, value in requests.of_job(COSTS[rule], points).items()
    }
