"""Whether all results are, byte for byte, what the jobs of the workflow wrote."""

import shlex
import sys
from pathlib import Path

from hopper_workflow.publish import run


def verify() -> None:
    """Print what is damaged and how to rebuild just that, with exit code 1; or that all is well.

    Results that do not exist yet are counted, not faulted.
    """
    try:
        rows = run.summary()
    except run.RunError as error:
        sys.exit(str(error))
    damaged = run.damages(rows)
    for path, fault in damaged.items():
        print(f"{path} is {fault}")
    if damaged:
        print(f"\nRebuild what is damaged with:\nsnakemake --force {shlex.join(damaged)}")
        sys.exit(1)
    existing = sum(Path(row["output_file"]).exists() for row in rows)
    print(f"{existing} of {len(rows)} results exist, and all are what their jobs wrote")


if __name__ == "__main__":
    verify()
