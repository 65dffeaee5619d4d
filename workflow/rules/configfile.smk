# =================================================================================================
# The text of the configuration file, checked before Snakemake reads it: Snakemake takes the last of
# two equal keys, and runs as a program what has the key __use_yte__
# =================================================================================================

import shlex
import sys

from snakemake.exceptions import WorkflowError

# The host of a module keeps its sys.path.
sys.path.append(str(ROOT / "scripts"))
from hopper_workflow import code_graph, configuration, requests
from hopper_workflow.claims.words import paths_of, read_claims

sys.path.remove(str(ROOT / "scripts"))

SCHEMA = ROOT / "workflow/schemas/config.schema.yaml"

# Snakemake puts the interpreter into shell commands as it is: a path with a space breaks them.
if Path(sys.executable).exists():
    sys.executable = shlex.quote(sys.executable)

# In a module the configuration is somebody else's, of which we know only our part.
if not workflow.modifier.skip_configfile:
    try:
        for path in [Path("config.yaml"), *workflow.overwrite_configfiles]:
            if path.exists():
                configuration.check_file(path, SCHEMA)
    except configuration.ConfigurationError as error:
        raise WorkflowError(str(error)) from None
