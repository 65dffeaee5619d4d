"""What ``hopper table`` answers: a list of hoppers, each row with its answer or its reason."""

import hashlib
import json
import multiprocessing
import os
import sys
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from itertools import repeat
from pathlib import Path
from time import monotonic
from typing import Any

from hopper.design.judgement import Judgement, judge_hopper
from hopper.errors import HopperError
from hopper_cli import sentences, sheet_files
from hopper_cli.columns import SHORT, Columns
from hopper_cli.errors import UsageError
from hopper_data.hopper_lists import HopperList, ListError, read_hoppers

# Rows of a task, and seconds between two reports of progress.
_TASK, _BETWEEN = 20, 1.0
_Answer = dict[str, Any]


def answer(options: Namespace) -> str:
    """Answer all rows of a list, write them, and return a summary.

    Raises
    ------
    UsageError
        If the list or the results cannot be read or written.
    """
    try:
        hoppers = read_hoppers(options.list)
    except ListError as error:
        raise UsageError(f"argument LIST: {error}") from None
    columns = Columns(options.columns)
    taken = [title for title in hoppers.titles if title in columns.titles]
    if taken:
        raise UsageError(f"argument LIST: the column {taken[0]} is one of the answer's: rename it")
    try:
        answers = _answered(hoppers, columns, options.out, options.cores)
        rows = ({**given, **found} for given, found in zip(hoppers.rows, answers, strict=True))
        sheet_files.write(options.out, (*hoppers.titles, *columns.titles), rows)
        _journal(options.out).unlink(missing_ok=True)
    except OSError as error:
        raise UsageError(f"argument --out: {options.out} cannot be written: {error}") from error
    without = sum(not each["verdict"] for each in answers)
    rest = f", {without} without a verdict: see the column reason" if without else ""
    return f"{len(answers)} hoppers answered in {options.out}{rest}."


def row_answer(hoppers: HopperList, row: int, columns: Columns) -> _Answer:
    """Return the answer about a row by the names of its columns, None for what does not exist."""
    try:
        case, disturbances = hoppers.case(row)
        found = judge_hopper(case.material, case.hopper.half_angle, disturbances)
    except HopperError as error:
        return {**dict.fromkeys(columns.titles), "reason": str(error)}
    return columns.fill(_cells(found), case, disturbances)


def _cells(found: Judgement) -> _Answer:
    stability = found.stability
    values = (
        found.pattern and sentences.mass_flow_sentence(found.pattern),
        stability and stability.verdict,
        stability and stability.abscissa,
        stability and stability.error_estimate,
        stability and stability.governed_by,
        found.flow_factor and found.flow_factor.value,
        found.flow_factor and found.flow_factor.error,
        found.reason or None,
    )
    return dict(zip(SHORT, values, strict=True))


def _answered(hoppers: HopperList, columns: Columns, out: Path, cores: int) -> list[_Answer]:
    """Answer what a run that was stopped has not, and keep each answer at once."""
    journal = _journal(out)
    mark = hashlib.sha256(repr((hoppers.titles, hoppers.rows, columns.titles)).encode()).hexdigest()
    known = _kept(journal, mark)
    missing = [row for row in range(len(hoppers.rows)) if row not in known]
    # Hoppers of one material have fields in common that are kept.
    missing.sort(key=hoppers.material)
    with journal.open("a" if known else "w", encoding="utf-8") as file:
        if not known:
            file.write(f"{mark}\n")
        try:
            for row, found in _computed(hoppers, columns, missing, cores):
                known[row] = found
                file.write(json.dumps([row, found]) + "\n")
                file.flush()
        except KeyboardInterrupt:
            print(
                f"\nhopper: stopped after {len(known)} of {len(hoppers.rows)} rows: the same "
                "command goes on from there",
                file=sys.stderr,
            )
            raise
    return [known[row] for row in range(len(hoppers.rows))]


def _journal(out: Path) -> Path:
    return out.with_name(f".{out.name}.journal")


def _kept(journal: Path, mark: str) -> dict[int, _Answer]:
    """Return the answers of a run of the same list that was stopped."""
    if not journal.is_file():
        return {}
    first, *lines = journal.read_text(encoding="utf-8").splitlines() or [""]
    if first != mark:
        return {}
    found = {}
    for line in lines:
        try:
            row, answered = json.loads(line)
        except json.JSONDecodeError:  # the one that was being written
            continue
        found[row] = answered
    return found


def _computed(
    hoppers: HopperList, columns: Columns, rows: list[int], cores: int
) -> Iterator[tuple[int, _Answer]]:
    tasks = [rows[start : start + _TASK] for start in range(0, len(rows), _TASK)]
    lists = (replace(hoppers, rows=tuple(hoppers.rows[row] for row in task)) for task in tasks)
    done, due = 0, monotonic() + _BETWEEN
    with _workers(min(cores, len(tasks))) as each:
        for task, found in zip(tasks, each(_task, lists, repeat(columns)), strict=True):
            yield from zip(task, found, strict=True)
            done += len(found)
            if sys.stderr.isatty() and monotonic() >= due:
                due = monotonic() + _BETWEEN
                print(f"\rhopper: {done} of {len(rows)} rows", end="", file=sys.stderr, flush=True)


@contextmanager
def _workers(count: int) -> Iterator[Callable[..., Iterable[list[_Answer]]]]:
    """Yield a map in this process, or in several where there is work for them."""
    if count < 2:
        yield map
        return
    # Several threads of each process would only wait for each other.
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    pool = ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("spawn"))
    try:
        yield pool.map
    finally:
        pool.shutdown(cancel_futures=True)


def _task(hoppers: HopperList, columns: Columns) -> list[_Answer]:
    return [row_answer(hoppers, row, columns) for row in range(len(hoppers.rows))]
