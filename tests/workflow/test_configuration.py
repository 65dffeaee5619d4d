"""Bad configurations end in one readable error that names the key, before any job starts."""

import copy
import os
import subprocess
import sys
from math import atan, radians

import numpy as np
import pytest
import yaml

from hopper_workflow import configuration, reading, strict_yaml
from hopper import Hopper, solve_radial
from tests.workflow.conftest import ROOT

SCHEMA = ROOT / "workflow/schemas/config.schema.yaml"


@pytest.fixture
def config():
    return yaml.safe_load((ROOT / "config.yaml").read_text(encoding="utf-8"))


def assign(config, key, value):
    *parents, last = key.split(".")
    for name in parents:
        config = config[name]
    config[last] = value


def test_the_shipped_configuration_is_valid(config):
    configuration.check(config, SCHEMA)


PLANE = "pseudospectrum.fig_pseudospectrum"
BAD = [
    ("radial.fig_3_1.delta_deg", 95, "'radial.fig_3_1.delta_deg': 95 is greater than"),
    ("radial.fig_3_1.delta_deg", "30", "'radial.fig_3_1.delta_deg': '30' is not of type 'number'"),
    ("radial.fig_3_1.delta_deg", float("nan"), "'radial.fig_3_1.delta_deg' is nan: give a finite"),
    ("radial.fig_3_1.half_angle_deg", 0, "'radial.fig_3_1.half_angle_deg': 0 is less than"),
    ("radial.fig_3_1.half_angle_deg", float("inf"), "'radial.fig_3_1.half_angle_deg' is inf"),
    ("radial.fig_3_1.geometry", "sphere", "'radial.fig_3_1.geometry': 'sphere' is not one of"),
    ("radial.fig_3_1.models", ["tresca"], r"'radial.fig_3_1.models\[0\]': 'tresca' is not one of"),
    ("radial.fig_3_1.mu", [], "'radial.fig_3_1.mu': .* should be non-empty"),
    ("radial.fig_3_1.mu", [-0.1], r"'radial.fig_3_1.mu\[0\]': -0.1 is less than the minimum of 0"),
    ("radial.fig_3_1.points", 10.5, "'radial.fig_3_1.points': 10.5 is not of type 'integer'"),
    ("radial.fig_3_1.typo", 1, r"'radial.fig_3_1': .*'typo' was unexpected"),
    ("radial.fig_9_9", {}, "'radial.fig_9_9': 'geometry' is a required property"),
    ("spectra.fig_4_2.nodes", 401, "'spectra.fig_4_2.nodes': 401 is not a multiple of 2"),
    ("spectra.fig_4_2.nodes", 8, "'spectra.fig_4_2.nodes': 8 is less than the minimum of 16"),
    ("spectra.fig_4_2.coarse_nodes", 400, "coarse_nodes': 400 is not below nodes = 400"),
    ("spectra.fig_4_2.tolerance", 0, "tolerance': 0 is less than or equal to the minimum"),
    (f"{PLANE}.real.stop", -20, f"'{PLANE}.real.stop': -20 must be above start"),
    (f"{PLANE}.real.points", 1, f"'{PLANE}.real.points': 1 is less than the minimum"),
    (f"{PLANE}.formulations.paper.psi_scale", 0, "psi_scale': 0 is less than or"),
    ("stability_map.chunks", 0, "'stability_map.chunks': 0 is less than the minimum of 1"),
    ("extra", 1, r"'top level': .*'extra' was unexpected"),
]  # fmt: skip


@pytest.mark.parametrize(("key", "value", "message"), BAD)
def test_a_bad_value_is_named(config, key, value, message):
    assign(config, key, value)
    with pytest.raises(configuration.ConfigurationError, match=message) as caught:
        configuration.check(config, SCHEMA)
    assert "\n" not in str(caught.value)


def test_a_missing_key_is_named(config):
    del config["radial"]["fig_3_1"]["points"]
    message = "'radial.fig_3_1': 'points' is a required property"
    with pytest.raises(configuration.ConfigurationError, match=message):
        configuration.check(config, SCHEMA)


def test_what_an_older_configuration_lacks_or_need_not_have(config):
    shipped = copy.deepcopy(config)
    del config["claims"], config["borders"]["check"]
    config["domain_angle"]["tangency_points"] = 25
    configuration.check(config, SCHEMA)
    assert configuration.bring_up_to_date(config, SCHEMA) == [
        "config key 'domain_angle.tangency_points' is ignored, the domain ends on the limit of "
        "friction; remove it"
    ]
    assert config == shipped
    assert configuration.bring_up_to_date(config, SCHEMA) == []


NAME = "abcdefghijklmnopqrstuvwxyz012345"


def test_as_many_hoppers_as_the_schema_allows_can_be_read(config, tmp_path):
    longest = {"description": "é" * 120, "delta_deg": 40.123456, "half_angle_deg": 20.123456}
    config["cases"] = [
        {**config["cases"][0], **longest, "name": f"case_{count}_{NAME}"}
        for count in range(100, 300)
    ]
    path = tmp_path / "config.yaml"
    path.write_text(yaml.safe_dump(config, allow_unicode=True), encoding="utf-8")
    configuration.check_file(path, SCHEMA)
    configuration.check(strict_yaml.read(path), SCHEMA)
    path.write_text(path.read_text(encoding="utf-8") + "#" * 80_000, encoding="utf-8")
    with pytest.raises(configuration.ConfigurationError, match="has more than 80000 characters"):
        configuration.check_file(path, SCHEMA)


@pytest.mark.workflow
def test_an_older_configuration_still_runs_and_says_what_it_need_not_have(fresh):
    fresh.set("domain_angle.tangency_points", 25)
    done = fresh.snakemake("-n", "figures/fig_domain_angle.png")
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("config key 'domain_angle.tangency_points' is ignored") == 1


def test_every_key_of_the_schema_is_described():
    schema = yaml.safe_load(SCHEMA.read_text(encoding="utf-8"))

    def undescribed(node, path):
        for name, child in node.get("properties", {}).items():
            if "$ref" not in child:
                if "description" not in child:
                    yield f"{path}.{name}"
                yield from undescribed(child, f"{path}.{name}")

    found = list(undescribed(schema, ""))
    for name, definition in schema["$defs"].items():
        found += list(undescribed(definition, name))
    assert found == []


@pytest.mark.workflow
def test_the_workflow_stops_before_any_job(fresh):
    fresh.set("radial.fig_3_1.mu", [0, "steep"])
    done = fresh.snakemake()
    assert done.returncode != 0
    assert "config key 'radial.fig_3_1.mu[1]': 'steep' is not of type 'number'" in done.stderr
    assert "Traceback" not in done.stderr
    assert not (fresh.path / "results").exists()


@pytest.mark.workflow
def test_a_friction_without_solution_ends_in_one_line_and_leaves_nothing(fresh):
    fresh.set("radial.fig_3_2.mu", [0.36])
    done = fresh.snakemake("figures/fig_3_2.png")
    assert done.returncode != 0
    assert "NoRadialSolutionError: no radial solution at phi" in done.stderr
    assert "the largest friction that has one is phi = 19.7406 deg (mu = 0.358852)" in done.stderr
    assert "Traceback" not in (fresh.path / "logs/solve_radial/fig_3_2.log").read_text()
    assert not list(fresh.path.glob("results/**/*.nc"))


@pytest.mark.workflow
def test_the_papers_frame_is_used_beyond_the_tangency_and_says_where_it_is_singular(fresh):
    fresh.set("spectra.fig_4_2.mu", 0.4)
    fresh.build("results/spectrum/fig_4_2/cone_80.nc")
    found = reading.read(fresh.path / "results/spectrum/fig_4_2/cone_80.nc")
    hopper = Hopper("cone", radians(35), radians(10))
    psi = solve_radial(hopper, atan(0.4)).psi_at(np.radians(float(found.singular_theta)))
    assert np.degrees(psi[0]) == pytest.approx(45 - 35 / 2, abs=1e-9)
    log = (fresh.path / "logs/compute_spectrum/fig_4_2_cone_80.log").read_text()
    assert f"A of (4.1) is singular at theta = {float(found.singular_theta):.4f} deg" in log


def test_reading_a_configuration_loads_no_numerics():
    """Every start of Snakemake reads it: SciPy alone would double what that takes."""
    code = "import sys; from hopper_workflow import relations; print('scipy' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONPATH": str(ROOT / "scripts")},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == "False\n"
