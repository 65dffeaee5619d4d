# =================================================================================================
# The text of the configuration file, checked before Snakemake reads it: Snakemake takes the last of
# two equal keys, and runs as a program what has the key __use_yte__
# =================================================================================================

import sys

from snakemake.exceptions import WorkflowError

sys.path = [str(ROOT / "src"), str(ROOT / "scripts"), *sys.path]

from support import configuration

SCHEMA = ROOT / "workflow/schemas/config.schema.yaml"

# In a module the configuration is somebody else's, of which we know only our part.
if not workflow.modifier.skip_configfile:
    try:
        for path in [Path("config.yaml"), *workflow.overwrite_configfiles]:
            if path.exists():
                configuration.check_file(path, SCHEMA)
    except configuration.ConfigurationError as error:
        raise WorkflowError(str(error)) from None
