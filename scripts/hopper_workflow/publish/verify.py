"""Whether all results are, byte for byte, what the jobs of the workflow wrote.

Reads results and logs alone: it needs no configuration, no Snakemake and no write permission.
"""

import shlex
import sys

from hopper_workflow import effective
from hopper_workflow.publish import run


def verify() -> None:
    """Print what is damaged and how to rebuild just that, with exit code 1; or that all is well.

    Results that do not exist any more are counted, not faulted.
    """
    jobs = run.records()
    found = run.existing()
    damaged = run.damages(found, jobs)
    for path, fault in damaged.items():
        print(f"{path} is {fault}")
    if damaged:
        command = ["snakemake", "--force", *damaged, *effective.option(run.configuration())]
        print(f"\nRebuild what is damaged with:\n{shlex.join(command)}")
        sys.exit(1)
    written = {path for job in jobs for path in job.written}
    print(f"{len(found)} of {len(written)} results exist, and all are what their jobs wrote")


if __name__ == "__main__":
    verify()
