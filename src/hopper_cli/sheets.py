"""What ``hopper table`` answers: a list of hoppers, each row with its answer or its reason."""

import csv
import hashlib
import json
import multiprocessing
import os
import sys
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import Any, TextIO

from hopper.design.judgement import Judgement, judge_hopper
from hopper.errors import HopperError
from hopper_cli import sentences
from hopper_cli.errors import UsageError
from hopper_data.files import replacing
from hopper_data.hopper_lists import HopperList, ListError, harmless, read_hoppers

COLUMNS = (
    *("sentence", "verdict", "abscissa", "abscissa_error", "governed_by", "flow_factor"),
    *("flow_factor_error", "reason"),
)
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
    taken = [title for title in hoppers.titles if title in COLUMNS]
    if taken:
        raise UsageError(f"argument LIST: the column {taken[0]} is one of the answer's: rename it")
    try:
        answers = _answered(hoppers, options.out, options.cores)
        rows = [{**given, **found} for given, found in zip(hoppers.rows, answers, strict=True)]
        write(options.out, (*hoppers.titles, *COLUMNS), rows)
        _journal(options.out).unlink(missing_ok=True)
    except OSError as error:
        raise UsageError(f"argument --out: {options.out} cannot be written: {error}") from error
    without = sum(not each["verdict"] for each in answers)
    rest = f", {without} without a verdict: see the column reason" if without else ""
    return f"{len(answers)} hoppers answered in {options.out}{rest}."


def row_answer(hoppers: HopperList, row: int) -> _Answer:
    """Return the answer about a row by the names of its columns, None for what does not exist."""
    try:
        case, disturbances = hoppers.case(row)
        found = judge_hopper(case.material, case.hopper.half_angle, disturbances)
    except HopperError as error:
        return {**dict.fromkeys(COLUMNS), "reason": str(error)}
    return _cells(found)


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
    return dict(zip(COLUMNS, values, strict=True))


def _answered(hoppers: HopperList, out: Path, cores: int) -> list[_Answer]:
    """Answer what a run that was stopped has not, and keep each answer at once."""
    journal = _journal(out)
    mark = hashlib.sha256(repr((hoppers.titles, hoppers.rows, COLUMNS)).encode()).hexdigest()
    known = _kept(journal, mark)
    missing = [row for row in range(len(hoppers.rows)) if row not in known]
    with journal.open("a" if known else "w", encoding="utf-8") as file:
        if not known:
            file.write(f"{mark}\n")
        try:
            for row, found in _computed(hoppers, missing, cores):
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


def _computed(hoppers: HopperList, rows: list[int], cores: int) -> Iterator[tuple[int, _Answer]]:
    tasks = [rows[start : start + _TASK] for start in range(0, len(rows), _TASK)]
    done, due = 0, monotonic() + _BETWEEN
    with _workers(min(cores, len(tasks))) as each:
        for found in each(_task, [hoppers] * len(tasks), tasks):
            yield from found
            done += len(found)
            if sys.stderr.isatty() and monotonic() >= due:
                due = monotonic() + _BETWEEN
                print(f"\rhopper: {done} of {len(rows)} rows", end="", file=sys.stderr, flush=True)


@contextmanager
def _workers(count: int) -> Iterator[Callable[..., Iterable[list[tuple[int, _Answer]]]]]:
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


def _task(hoppers: HopperList, rows: list[int]) -> list[tuple[int, _Answer]]:
    return [(row, row_answer(hoppers, row)) for row in rows]


def write(out: Path, titles: Sequence[str], rows: list[_Answer]) -> None:
    """Write a table by the suffix of its name; it appears whole or not at all."""
    with replacing(out) as temporary:
        if out.suffix.lower() == ".json":
            temporary.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
        elif out.suffix.lower() == ".nc":
            from hopper_data import sheets

            sheets.write(temporary, titles, rows)
        else:
            with temporary.open("w", newline="", encoding="utf-8") as file:
                write_csv(file, titles, rows)


def write_csv(file: TextIO, titles: Sequence[str], rows: list[_Answer]) -> None:
    """Write a table of which no cell is a formula."""
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(titles)
    writer.writerows([_cell(row[title]) for title in titles] for row in rows)


def _cell(value: Any) -> Any:
    return harmless(value) if isinstance(value, str) else value
