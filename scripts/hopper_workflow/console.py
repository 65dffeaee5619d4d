"""What a run says on the screen: how far it is, and of a job that fails where to read more."""

import logging
from typing import Any, TextIO

# A line at least for each of so many equal parts of a run.
_LINES = 25


class Brief(logging.Filter):
    """Lets through what a user needs of Snakemake's messages, and tells the progress itself.

    Snakemake's own log, below .snakemake/log, keeps all of them.
    """

    def __init__(self, screen: TextIO) -> None:
        super().__init__()
        self._screen, self._told = screen, 0.0
        self._jobs: dict[int, str] = {}
        self._latest = ""

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a message is printed as it is."""
        event, known = str(getattr(record, "event", "")), vars(record)
        if event == "job_info":
            self._jobs[known["jobid"]] = known["rule_msg"] or known["rule_name"]
        elif event == "job_finished":
            self._latest = self._jobs.get(known["job_id"], "")
        elif event == "progress":
            self._tell(known["done"], known["total"])
        elif event == "job_error":
            self._explain(known)
        elif event == "run_info":
            self._print(f"{known['stats']['total']} jobs")
        else:
            text = str(record.msg)
            return not text.startswith(("Select jobs", "Execute ", "Finished jobid"))
        return False

    def _tell(self, done: int, total: int) -> None:
        if done == total or done / total - self._told >= 1 / _LINES:
            self._told = done / total
            share = 100 * done // total
            self._print(f"{done:>5} of {total}, {share:>3} %  {self._latest}")

    def _explain(self, known: dict[str, Any]) -> None:
        logs = " ".join(map(str, known["log"] or ()))
        self._print(f"failed: {known['rule_msg'] or known['rule_name']}; more: cat {logs}")

    def _print(self, line: str) -> None:
        self._screen.write(f"{line}\n")
        self._screen.flush()


class Full(logging.Filter):
    """Has Snakemake tell all of a job, as it does of rules without a message."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Take the message off what is told of a job."""
        if getattr(record, "event", None) == "job_info":
            record.rule_msg = None
        return True


def be_brief(logger: logging.Logger) -> None:
    """Make the handler of the screen brief, unless the run is a dry one or asked to be verbose.

    A dry run is for those who want to know: inputs, outputs and why jobs would run.
    """
    for handler in logger.handlers:
        if isinstance(handler, logging.StreamHandler) and not isinstance(
            handler, logging.FileHandler
        ):
            settings = [vars(each) for each in handler.filters if hasattr(each, "dryrun")]
            if any(each["dryrun"] or each["verbose"] for each in settings):
                handler.addFilter(Full())
            elif settings:
                handler.addFilter(Brief(handler.stream))
