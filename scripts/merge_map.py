"""One stability map from its chunks."""

from hopper_workflow import artifacts, jobs, merging

if __name__ == "__main__":
    jobs.run(artifacts.writing(merging.merged, "Stability map, {geometry}", "(4.1), (4.2)"))
