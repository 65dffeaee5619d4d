"""What a run says on the screen."""

import io
import logging

import pytest

from hopper_workflow import console


def record(event, message="", **known):
    made = logging.LogRecord("snakemake", logging.INFO, "", 0, message, None, None)
    vars(made).update(event=event, **known)
    return made


def run(jobs):
    """Yield what Snakemake tells of a run of so many jobs."""
    yield record("run_info", "Job stats: ...", stats={"total": jobs})
    for number in range(jobs):
        yield record(None, "Select jobs to execute...")
        told = {"jobid": number, "rule_msg": f"solve/{number}: fields", "rule_name": "solve"}
        yield record("job_info", **told)
        yield record("job_finished", "Finished jobid", job_id=number)
        yield record("progress", done=number + 1, total=jobs)


@pytest.mark.parametrize("jobs", [1, 3, 86, 10_000])
def test_a_run_is_a_page_with_stage_and_share(jobs):
    screen = io.StringIO()
    brief = console.Brief(screen)
    assert not any(brief.filter(each) for each in run(jobs))
    lines = screen.getvalue().splitlines()
    assert lines[0] == f"{jobs} jobs"
    assert len(lines) <= 27
    assert lines[-1].split() == [*f"{jobs} of {jobs}, 100 % solve/{jobs - 1}: fields".split()]


def test_a_failing_job_is_one_line_with_the_command_to_see_more():
    screen = io.StringIO()
    failed = {"rule_msg": "solve/a: fields", "rule_name": "solve", "log": ["logs/solve/a.log"]}
    assert not console.Brief(screen).filter(record("job_error", input=["module.py"] * 40, **failed))
    assert screen.getvalue() == "failed: solve/a: fields; more: cat logs/solve/a.log\n"


def test_other_messages_pass():
    assert console.Brief(io.StringIO()).filter(record(None, "Nothing to be done"))
