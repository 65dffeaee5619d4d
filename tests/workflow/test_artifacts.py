"""Artifacts: conventions, provenance, identical bytes, logs; damaged ones are refused."""

import json
import subprocess
import sys
from functools import partial
from pathlib import Path

import netCDF4
import numpy as np
import pytest

from hopper_workflow import artifacts, columns, reading
from tests.reliability import comparison, record

pytestmark = pytest.mark.workflow


def files(workflow, folder, pattern):
    found = sorted((workflow.path / folder).rglob(pattern))
    assert found
    return found


def test_every_artifact_describes_itself(built):
    for path in files(built, "results", "*.nc"):
        with netCDF4.Dataset(path) as data:
            for name in ("Conventions", "title", "source", "references", "parameters", "summary"):
                assert data.getncattr(name), f"{path.name} lacks {name}"
            assert data.Conventions.startswith("CF-1.")
            assert json.loads(data.parameters)
            for name, variable in data.variables.items():
                assert variable.long_name, f"{path.name}: {name}"
                if variable.dtype is not str and not hasattr(variable, "flag_values"):
                    assert variable.units, f"{path.name}: {name}"
                assert not isinstance(variable.datatype, netCDF4.CompoundType)


def test_compliance_checker_finds_no_cf_error(built, tmp_path):
    checker, report = Path(sys.executable).with_name("compliance-checker"), tmp_path / "report.json"
    paths = files(built, "results", "*.nc")
    command = [checker, "--test=cf:1.11", "--format=json_new", f"--output={report}", *paths]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert report.exists(), done.stderr
    results = json.loads(report.read_text())
    assert results.keys() == {str(path) for path in paths}
    for path, result in results.items():
        checked = result["cf:1.11"]
        problems = [item["msgs"] for item in checked["high_priorities"] if item["msgs"]]
        problems += [item["msgs"] for item in checked["medium_priorities"] if item["msgs"]]
        assert not problems, f"{path}: {problems}"


def test_provenance_matches_its_artifact(built):
    for path in files(built, "results", "*.nc"):
        record = json.loads(path.with_suffix(".provenance.json").read_text())
        assert record["sha256"] == artifacts.checksum(path)
        assert record["artifact"] == path.name
        for key in ("created", "commit", "python", "packages", "parameters", "hopper"):
            assert key in record


def build_elsewhere(workflow, *targets):
    """Build with another number of cores, time zone and locale than the shared workflow."""
    workflow.build("--cores", "1", *targets, TZ="Asia/Tokyo", LC_ALL="C")


@pytest.mark.soak
def test_some_artifacts_and_figures_are_identical_in_another_place(built, fresh):
    targets = {
        "figures/fig_4_1.pdf", "figures/fig_4_2.png", "figures/fig_jenike.png",
        "results/map/cone_10.nc", "results/pseudospectrum/fig_pseudospectrum/cone_paper.nc",
    }  # fmt: skip
    build_elsewhere(fresh, *targets)
    found = fresh.products()
    assert targets <= found.keys()
    assert found.items() <= built.products().items()


@pytest.mark.soak
def test_artifacts_and_figures_are_identical_in_another_place(built, fresh):
    build_elsewhere(fresh)
    found, expected = fresh.products(), built.products()
    assert found == expected
    record(
        "determinism",
        "Two runs on one machine, in directories with and without a space in their names, at two "
        "times, with one core and two, in two time zones and two locales, gave identical bytes of "
        "every artifact, table and figure.",
        comparison(found, expected),
    )


@pytest.mark.soak
def test_the_number_of_chunks_does_not_change_the_map(built, rebuilt):
    path, chunks = "results/map/cone_10.nc", [1, 7]
    found = {artifacts.checksum(built.path / path)}
    for number in chunks:
        rebuilt.set("stability_map.chunks", number)
        rebuilt.build(path)
        found.add(artifacts.checksum(rebuilt.path / path))
        assert len(found) == 1
    record(
        "chunks",
        "A map computed in other numbers of jobs has the same bytes.",
        {"numbers of jobs": ", ".join(map(str, chunks)), "with other bytes": len(found) - 1},
    )


def test_a_map_tells_why_there_is_no_verdict(built):
    for path in files(built, "results/map", "*_[0-9]*.nc"):
        data = reading.read(path)
        signs = {
            "stable": (data.abscissa < 0) & (data.abscissa_symmetric < 0),
            "stable_symmetric_only": (data.abscissa >= 0) & (data.abscissa_symmetric < 0),
            "unstable": data.abscissa_symmetric >= 0,
        }
        for region, expected in signs.items():
            assert np.array_equal(data.region == region, expected), (path, region)
        assert np.array_equal(np.isfinite(data.abscissa), np.isin(data.region, list(signs)))
        assert np.array_equal(np.isfinite(data.abscissa), data.governed_by != "none")


def test_error_estimates_are_in_the_artifacts(built):
    for path in files(built, "results/radial", "*.nc"):
        data = reading.read(path)
        for name in ("error_radial", "error_velocity"):
            assert np.all((data[name] > 0) & (data[name] < 1e-10))


def test_logs_receive_what_the_script_says(built):
    for path in files(built, "logs", "*.log"):
        text = path.read_text(encoding="utf-8")
        assert ": started\n" in text
        assert ": done\n" in text
        assert path.with_suffix(".benchmark.tsv").is_file()


def test_an_artifact_of_another_configuration_is_refused(built):
    path = built.path / "results/radial/fig_3_1.nc"
    for read in (reading.read, partial(columns.read, names=[])):
        with pytest.raises(artifacts.ArtifactError, match="another configuration"):
            read(path, parameters={"delta_deg": 31})


def test_columns_are_what_xarray_reads(built):
    """Numbers with and without coordinates, flags, complex numbers, and the parameters."""
    for path in files(built, "results", "*.nc"):
        whole = reading.read(path, stored=True)
        found = columns.read(path, list(map(str, whole.variables)), json.loads(whole.parameters))
        for name, values in found.items():
            np.testing.assert_array_equal(values, whole[name].to_numpy(), err_msg=f"{path} {name}")


def test_an_interrupted_write_leaves_nothing(tmp_path):
    def interrupted():
        with artifacts.replacing(tmp_path / "artifact.nc") as partial:
            partial.write_text("half")
            raise RuntimeError("disk gone")

    with pytest.raises(RuntimeError, match="disk gone"):
        interrupted()
    assert list(tmp_path.iterdir()) == []
