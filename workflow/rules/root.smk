# =================================================================================================
# Where the code is: this clone, or a checkout of the commit that github(...) in a module names
# =================================================================================================

import contextlib
import tempfile
from pathlib import Path

from snakemake.sourcecache import HostingProviderFile


def checkout(source):
    """Unpack a hosted repository once below the working directory: scripts import from it."""
    repository = source.hosted_repo.repo
    commit = repository.commit(source.ref).hexsha
    target = Path(".snakemake/hopper", commit).absolute()
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=target.parent) as partial:
            clone = repository.clone(Path(partial, "clone"))
            clone.git.checkout(commit)
            with contextlib.suppress(FileExistsError):  # another process was first
                Path(clone.working_dir).rename(target)
    return target


HERE = workflow.current_basedir
if isinstance(HERE, HostingProviderFile):
    ROOT = checkout(HERE)
    SCRIPTS = ROOT / "scripts"
else:
    ROOT = Path(HERE).parent.parent
    SCRIPTS = "../../scripts"
