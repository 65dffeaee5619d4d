"""What jobs ask of a cluster follows from the table of measured costs, and covers every rule."""

import re
import sys

import numpy as np
import pytest
import xarray as xr
import yaml
from benchmarks import requests as measured

from hopper_workflow import domains
from hopper_workflow.requests import Cost, of_job, read_costs
from tests.slurm import cluster
from tests.workflow.conftest import ROOT

COSTS = read_costs(measured.TABLE)
RULES = "\n".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk"))


def test_profile_and_document_are_those_of_the_table():
    for path, text in measured.rendered(COSTS).items():
        assert path.read_text(encoding="utf-8") == text, f"{path.name}: run `make requests`"
    assert measured.table(COSTS) == measured.TABLE.read_text(encoding="utf-8")


def test_every_rule_has_a_request_and_no_other_has():
    block = r"^(?:use rule \w+ as|rule) (\w+)(?: with)?:\n(.*?)(?=^(?:use )?rule |\Z)"
    blocks = dict(re.findall(block, RULES, re.MULTILINE | re.DOTALL))
    by_size = {name for name, block in blocks.items() if f'asks("{name}"' in block}
    fixed = set(yaml.safe_load(measured.PROFILE.read_text(encoding="utf-8"))["set-resources"])
    assert by_size == set(measured.OF_MAPS)
    assert fixed.isdisjoint(by_size)
    assert fixed | by_size == set(COSTS) == set(blocks)


def test_a_request_is_larger_than_the_cost():
    for cost in COSTS.values():
        asked = of_job(cost)
        assert 60 * asked["runtime"] > 3 * cost.seconds
        assert asked["mem_mb"] > 1.5 * cost.mebibytes + 500


def test_the_document_works_the_large_map_out_from_the_chunk():
    chunk = COSTS["compute_map_chunk"]
    hours = 10_000**2 * (chunk.seconds / chunk.points) / 3600
    text = measured.DOCUMENT.read_text(encoding="utf-8")
    assert f"{hours:.1f} core hours for a map, {4 * hours:.0f} for the 4" in text


@pytest.mark.workflow
def test_jobs_of_a_large_map_ask_by_its_size(fresh):
    for axis in ("delta_deg", "phi_deg"):
        fresh.set(f"stability_map.{axis}.points", 10_000)
    fresh.set("stability_map.chunks", 40)
    done = fresh.snakemake("-n", "results/map/cone_10.nc", "figures/fig_4_5_map.png")
    assert done.returncode == 0, done.stderr
    asked = {
        (rule, int(minutes), int(megabytes))
        for rule, minutes, megabytes in re.findall(
            r"^rule (\w*map\w*):(?:\n .*)*?runtime=(\d+), mem_mb=(\d+)", done.stdout, re.MULTILINE
        )
    }
    # Minutes: 5, and three times the time of the points; MB: 500, and half again the memory.
    points = {"compute_map_chunk": 2_500_000, "merge_map": 10**8, "plot_fig_4_5_map": 10**8}
    assert {rule for rule, *_ in asked} == set(points)
    assert len(asked) == len(points)
    for rule, minutes, megabytes in asked:
        cost = COSTS[rule]
        seconds = cost.seconds + 1e-6 * cost.microseconds * (points[rule] - cost.points)
        memory = cost.mebibytes * 2**20 + cost.bytes * (points[rule] - cost.points)
        assert minutes - 1 < 5 + 3 * seconds / 60 <= minutes
        assert megabytes - 100 < 500 + 1.5 * memory / 1e6 <= megabytes


def test_the_slowest_and_the_largest_job_of_a_rule_count(tmp_path):
    for name, seconds, memory in [("a/x", 1.5, 200), ("a/y", 2.5, 100), ("b", 3, 50)]:
        path = tmp_path / f"logs/{name}.benchmark.tsv"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"s\tmax_rss\n{seconds}\t{memory}\n")
    assert measured.measured(tmp_path) == {"a": Cost("a", 2.5, 200), "b": Cost("b", 3, 50)}


def test_without_benchmarks_there_is_one_line(tmp_path):
    with pytest.raises(SystemExit, match="make a full run first"):
        measured.measured(tmp_path)


@pytest.mark.parametrize(("side", "drawn"), [(7, 7), (10, 10), (11, 6), (30, 10), (31, 8)])
def test_a_large_map_is_drawn_thinned(side, drawn):
    values = np.arange(side * side, dtype=float).reshape(side, side)
    data = xr.Dataset({"abscissa": (("delta", "phi"), values)})
    found = domains.thinned(data, 10).abscissa.to_numpy()
    step = -(-side // drawn)
    np.testing.assert_array_equal(found, values[::step, ::step])
    assert found.shape == (drawn, drawn)


def test_another_slurm_is_left_alone(tmp_path, monkeypatch):
    foreign = tmp_path / "slurm.conf"
    foreign.write_text("ClusterName=theirs\n")
    monkeypatch.setattr(cluster, "CONFIG", foreign)
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr("os.geteuid", lambda: 0)
    with pytest.raises(cluster.ClusterError, match="belongs to another SLURM"):
        cluster.prepare()
    assert foreign.read_text() == "ClusterName=theirs\n"


def test_a_slurm_needs_root(monkeypatch):
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    with pytest.raises(cluster.ClusterError, match="root"):
        cluster.prepare()
