"""What a process inherits from its user's surroundings, and what of it must not enter a result."""

import locale
import os
import re
import sys
import sysconfig
from collections.abc import Iterable, Mapping
from pathlib import Path

# Variables by their beginnings: of Python, Matplotlib, NumPy, SciPy, BLAS and its threads, xarray,
# HDF5 and netCDF, git, Snakemake, the shell of jobs, the C library's choice of code.
FOREIGN = (
    *("PYTHON", "MPL", "MATPLOTLIBRC", "NPY_", "NUMPY_", "SCIPY_", "OPENBLAS_", "GOTO_", "OMP_"),
    *("GOMP_", "KMP_", "MKL_", "BLIS_", "VECLIB_", "NUMEXPR_", "XARRAY_", "HDF5_", "NETCDF", "NC_"),
    *("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "SNAKEMAKE_", "BASH_ENV", "SHELLOPTS"),
    *("BASHOPTS", "CDPATH", "SOURCE_DATE_EPOCH", "GLIBC_TUNABLES"),
)
# Of these, what only says where caches are kept and when text is written.
_HARMLESS = ("PYTHONDONTWRITEBYTECODE", "PYTHONPYCACHEPREFIX", "PYTHONUNBUFFERED", "MPLCONFIGDIR")
_OURS = {
    "PYTHONUTF8": "1",
    "MPLBACKEND": "Agg",
    # Locks guard files that others have open; ours are new, and move to their place when complete.
    "HDF5_USE_FILE_LOCKING": "FALSE",
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
}


def settled(environment: Mapping[str, str]) -> dict[str, str]:
    """Return the environment that jobs are to have in place of the user's."""
    harmless = _HARMLESS if _self_contained() else (*_HARMLESS, "PYTHONPATH")
    kept = {
        name: value
        for name, value in environment.items()
        if name in harmless or not name.startswith(FOREIGN)
    }
    return kept | _OURS


def set_aside(environment: Mapping[str, str]) -> list[str]:
    """Return the names, sorted, of variables that :func:`settled` leaves out or overrides."""
    ours = settled(environment)
    return sorted(name for name, value in environment.items() if ours.get(name) != value)


def own_path(path: Iterable[str], environment: Mapping[str, str]) -> list[str]:
    """Return a search path of modules, which jobs get too, without what PYTHONPATH put there."""
    added = environment.get("PYTHONPATH", "") if "PYTHONPATH" in set_aside(environment) else ""
    foreign = {os.path.abspath(folder) for folder in added.split(os.pathsep) if folder}
    return [folder for folder in path if folder not in foreign - {*sysconfig.get_paths().values()}]


def _self_contained() -> bool:
    """Whether this Python's packages are all in its own environment, not on PYTHONPATH."""
    return sys.prefix != sys.base_prefix or Path(sys.prefix, "conda-meta").is_dir()


def refused(threads: Mapping[str, object]) -> str | None:
    """Return what cannot be set aside and would enter results, in one line, or None.

    ``threads`` are the numbers of threads by rule that options or a profile of Snakemake set.
    """
    encoding = locale.getpreferredencoding(False)
    if not re.fullmatch(r"utf-?8", encoding, re.IGNORECASE):
        return f"this locale makes Python read text as {encoding}: set PYTHONUTF8=1"
    if threads:
        return f"threads of {', '.join(sorted(threads))} are set: results depend on them; leave out"
    return None
