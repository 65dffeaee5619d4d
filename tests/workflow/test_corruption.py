"""Damaged results: none is believed, every one is named, and the command given rebuilds just it."""

import random
import re
import shlex
from collections import Counter
from pathlib import Path

import pytest

from hopper_workflow import artifacts, logs, reading
from hopper_workflow.publish import run
from tests.reliability import record

pytestmark = pytest.mark.workflow


def truncated(content, foreign):
    return content[: len(content) // 2]


def flipped(content, foreign):
    position = random.Random(len(content)).randrange(8 * len(content))
    changed = bytearray(content)
    changed[position // 8] ^= 1 << position % 8
    return bytes(changed)


def emptied(content, foreign):
    return b""


def replaced(content, foreign):
    return foreign


FAULTS = [truncated, flipped, emptied, replaced]


def kinds(outputs):
    """Return the files of the workflow by kind: artifacts, side files, figures and tables, logs."""
    return {
        "artifacts": [path for path in outputs if path.endswith(".nc")],
        "provenance": [path for path in outputs if path.endswith(".provenance.json")],
        "figures and tables": [path for path in outputs if not path.endswith((".nc", ".json"))],
        "logs": sorted(str(path) for path in Path("logs").rglob("*.log")),
    }


def test_every_fault_in_every_file_is_found(rebuilt, monkeypatch):
    monkeypatch.chdir(rebuilt.path)
    outputs = run.existing()
    assert run.damages(outputs, run.records()) == {}
    made_by = {path: {*logs.record(path).written} for path in kinds(outputs)["logs"]}
    assert sorted(set().union(*made_by.values())) == outputs
    counts: Counter[str] = Counter()
    missed, sound = 0, run.records()
    for kind, paths in kinds(outputs).items():
        # Another file of the same kind: readable, but not what belongs there.
        neighbours = dict(zip(paths, [*paths[1:], paths[0]], strict=True))
        contents = {path: Path(path).read_bytes() for path in paths}
        for path, content in contents.items():
            expected = made_by.get(path, {path})
            for fault in FAULTS:
                Path(path).write_bytes(fault(content, contents[neighbours[path]]))
                counts[f"faults in {kind}"] += 1
                # Logs are read anew where one was damaged; files are looked at one by one.
                jobs = run.records() if kind == "logs" else sound
                missed += set(run.damages(expected, jobs)) != expected
                assert not missed, f"{path} {fault.__name__}"
                if path.endswith(".nc"):
                    with pytest.raises(
                        artifacts.ArtifactError, match=r"damaged or foreign.*--force"
                    ):
                        reading.read(path)
                if path.endswith(".provenance.json") and fault is not flipped:
                    with pytest.raises(artifacts.ArtifactError, match=r"damaged|no readable"):
                        reading.read(path.replace(".provenance.json", ".nc"))
            Path(path).write_bytes(content)
    assert run.damages(outputs, run.records()) == {}
    record(
        "corruption",
        "Every file of a run and every log was truncated, had a bit flipped, was emptied, and was "
        "exchanged for another of its kind. All faults were found and named by `make verify`; "
        "damaged artifacts were refused by all that read them.",
        {**counts, "not found": missed},
    )


@pytest.mark.soak
def test_what_is_named_is_rebuilt_and_nothing_else(built, rebuilt):
    damage = {
        "results/radial/fig_3_1.nc": truncated,
        "results/smooth_wall.nc": flipped,
        "results/map/cone_10.nc": emptied,
        "figures/fig_3_2.png": replaced,
    }
    for path, fault in damage.items():
        file = rebuilt.path / path
        file.write_bytes(
            fault(file.read_bytes(), (rebuilt.path / "figures/fig_3_1.png").read_bytes())
        )
    before = {path: path.stat().st_mtime_ns for path in rebuilt.path.glob("results/**/*.nc")}

    refused = rebuilt.publish("verify")
    assert refused.returncode == 1
    assert set(re.findall(r"^(\S+) is damaged or foreign", refused.stdout, re.MULTILINE)) == {
        *damage
    }
    for what in ("report", "crate"):
        stopped = rebuilt.publish(what)
        assert stopped.returncode == 1
        assert "make verify" in stopped.stderr or "out of date" in stopped.stderr

    program, *arguments = shlex.split(refused.stdout.splitlines()[-1])
    assert program == "snakemake"
    rebuilt.build(*arguments)
    sound = rebuilt.publish("verify")
    assert sound.returncode == 0, sound.stdout
    assert "all are what their jobs wrote" in sound.stdout
    written = {path for path, time in before.items() if path.stat().st_mtime_ns != time}
    assert written == {rebuilt.path / path for path in damage if path.endswith(".nc")}
    for path in damage:
        assert logs.checksum(rebuilt.path / path) == logs.checksum(built.path / path)


def test_a_damaged_artifact_does_not_reach_its_figure(rebuilt):
    artifact, figure = "results/radial/fig_3_1.nc", "figures/fig_3_1.png"
    content = (rebuilt.path / artifact).read_bytes()
    (rebuilt.path / artifact).write_bytes(flipped(content, b""))
    done = rebuilt.snakemake(figure, "--force")
    assert done.returncode == 1
    named = re.search(rf"ArtifactError: artifact {artifact} is damaged or foreign", done.stderr)
    assert named, done.stderr
    assert "Traceback" not in done.stderr
    assert not (rebuilt.path / figure).exists()


def test_a_missing_artifact_is_named_with_its_remedy(rebuilt):
    path = rebuilt.path / "results/radial/fig_3_1.nc"
    path.unlink()
    with pytest.raises(artifacts.ArtifactError, match="missing: build it with: snakemake"):
        reading.read(path)


def test_a_log_that_was_not_sealed_vouches_for_nothing(tmp_path):
    log, output, source = (tmp_path / name for name in ("job.log", "output", "source"))
    source.write_bytes(b"data")
    with pytest.raises(logs.LogError, match="cannot be read"):
        logs.record(log)
    log.write_text("started\n", encoding="utf-8")
    with pytest.raises(logs.LogError, match="not as the job left it"):
        logs.record(log)
    output.write_bytes(b"result")
    logs.seal(log, [str(output)], [str(source)])
    assert logs.record(log).written == {str(output): logs.checksum(output)}
    assert logs.record(log).read == {str(source): logs.checksum(source)}
    log.write_text(log.read_text(encoding="utf-8") + "appended\n", encoding="utf-8")
    with pytest.raises(logs.LogError):
        logs.record(log)
