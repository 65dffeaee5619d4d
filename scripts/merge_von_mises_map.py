"""One map of von Mises cones from its chunks."""

from hopper_workflow import artifacts, jobs, merging

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            merging.merged, "Map of verdicts, von Mises {geometry}", "(2.8)-(2.15), linearised"
        )
    )
