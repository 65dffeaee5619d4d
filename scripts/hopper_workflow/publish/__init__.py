"""What leaves the repository: the report and the crate of a finished run.

Run in the directory of the workflow, as `make report` and `make crate` do.
"""
