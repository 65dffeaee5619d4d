# =================================================================================================
# The text of the configuration file, checked before Snakemake reads it: Snakemake takes the last of
# two equal keys, and runs as a program what has the key __use_yte__
# =================================================================================================

import os
import shlex
import sys

from snakemake.exceptions import WorkflowError
from snakemake.logging import logger

# Ours before others of their names; the host of a module keeps its sys.path.
sys.path[:] = [str(ROOT / "scripts"), *sys.path]
from hopper_workflow import (
    cases,
    code_graph,
    configuration,
    console,
    effective,
    entries,
    live,
    own_hoppers,
    requests,
    surroundings,
    targets,
)
from hopper_workflow.claims.words import half_angles_in, paths_of, read_claims

sys.path.remove(str(ROOT / "scripts"))

SCHEMA = ROOT / "workflow/schemas/config.schema.yaml"

# Snakemake puts the interpreter into shell commands as it is: a path with a space breaks them.
if Path(sys.executable).exists():
    sys.executable = shlex.quote(sys.executable)

# In a module environment and configuration are somebody else's, of which we know only our part.
if not workflow.modifier.skip_configfile:
    console.be_brief(logger)
    if foreign := surroundings.set_aside(os.environ):
        logger.info(f"Set aside from the environment: {' '.join(foreign)}")
    sys.path[:] = surroundings.own_path(sys.path, os.environ)
    settled = surroundings.settled(os.environ)
    os.environ.clear()
    os.environ.update(settled)
    if problem := surroundings.refused(workflow.resource_settings.overwrite_threads):
        raise WorkflowError(problem)
    if workflow.config_settings.config:
        raise WorkflowError(
            "--config cannot hold the sections of a configuration: write what is to change into a "
            "file and give it with --configfile"
        )
    try:
        for path in [Path("config.yaml"), *workflow.overwrite_configfiles]:
            if path.exists():
                configuration.check_file(path, SCHEMA)
    except configuration.ConfigurationError as error:
        raise WorkflowError(str(error)) from None


onstart:
    live.leave_record()
    effective.leave_record(config, SCHEMA)
