"""Hoppers of the list `cases`: artifacts, pages, honest partial results, bad names."""

import csv
import subprocess
import sys
from math import atan, radians

import numpy as np
import pytest
import yaml

from hopper_workflow import configuration, reading
from hopper import Hopper, assess
from hopper.assessment.summary import OUTCOMES
from tests.workflow.conftest import ROOT

SCHEMA = ROOT / "workflow/schemas/config.schema.yaml"
STEEL = {
    "name": "steel_cone",
    "geometry": "cone",
    "model": "mohr-coulomb",
    "delta_deg": 40,
    "half_angle_deg": 20,
    "mu": 0.3,
}


@pytest.fixture
def config():
    return yaml.safe_load((ROOT / "config.yaml").read_text(encoding="utf-8"))


@pytest.mark.workflow
def test_the_shipped_case_holds_what_the_numerics_know(built):
    data = reading.read(built.path / "results/cases/steel_cone.nc", parameters=STEEL)
    found = assess(Hopper("cone", radians(40), radians(20)), atan(0.3))
    assert found.radial is not None
    assert found.stability is not None
    assert outcome_of(data) == found.outcome == "stable"
    for key in ("sigma_axis", "sigma_wall", "psi_wall", "psi_max", "u_wall", "flow_factor"):
        quantity = getattr(found.radial, key)
        assert float(data[key]) == pytest.approx(quantity.value, rel=1e-12)
        assert 0 < float(data[f"{key}_error"]) < 1e-10
    spectrum = found.stability.spectrum
    np.testing.assert_allclose(data.eigenvalue.to_numpy(), spectrum.eigenvalues, rtol=1e-9)
    ends = [float(data[key]) for key in ("sigma_wall", "sigma_axis", "sigma_wall")]
    np.testing.assert_allclose(data.sigma[[0, 120, -1]], ends, rtol=1e-12)
    for suffix in ("png", "pdf"):
        assert (built.path / f"figures/case_steel_cone.{suffix}").stat().st_size > 10_000


def outcome_of(data):
    assert data.outcome.item() in OUTCOMES
    return data.outcome.item()


@pytest.mark.workflow
def test_cases_without_an_answer_hold_what_there_is_and_say_why(fresh):
    cases: dict[str, dict[str, object]] = {
        "tangent": {"mu": 0.35, "description": "a characteristic is tangent to an arc"},
        "beyond": {"mu": 0.48},
        "wide": {"half_angle_deg": 60, "mu": 0.2},
        "singular": {"delta_deg": 25, "half_angle_deg": 30, "mu": 0.4, "description": "料斗"},
        "mises": {"model": "von-mises"},
    }
    fresh.set("cases", [{**STEEL, **change, "name": name} for name, change in cases.items()])
    artifact_only = [f"results/cases/{name}.nc" for name in ("wide", "mises")]
    fresh.build(
        *artifact_only, *(f"figures/case_{name}.png" for name in ("tangent", "beyond", "singular"))
    )
    found = {name: reading.read(fresh.path / f"results/cases/{name}.nc") for name in cases}
    assert {name: outcome_of(data) for name, data in found.items()} == {
        "tangent": "stable",
        "beyond": "no_radial_solution",
        "wide": "no_radial_solution",
        "singular": "unstable",
        "mises": "unstable",
    }
    for name, data in found.items():
        answered = outcome_of(data) in ("stable", "unstable")
        assert ("comment" in data.attrs) == (name not in ("tangent", "mises"))
        assert ("abscissa" in data) == answered
        # No bare NaN: what does not exist is not there.
        for variable in data.values():
            assert variable.notnull().all()
    assert float(found["tangent"].mu_tangency) < 0.35
    assert float(found["tangent"].sigma_wall) > 0
    assert "the largest friction that has one is" in found["beyond"].comment
    assert float(found["beyond"].mu_limit) == pytest.approx(0.468082, abs=1e-6)
    assert "sigma" not in found["beyond"]
    assert "velocity is singular" in found["singular"].comment
    assert "u" not in found["singular"]
    assert "sigma" in found["singular"]
    log = (fresh.path / "logs/plot_case/singular.log").read_text(encoding="utf-8")
    assert "Glyph" in log, "the font of the figures has none of the description"
    checker = [sys.executable.replace("python", "compliance-checker"), "--test=cf:1.11"]
    for name in ("singular", "beyond"):
        path = fresh.path / f"results/cases/{name}.nc"
        done = subprocess.run([*checker, path], capture_output=True, text=True, check=False)
        assert "All tests passed!" in done.stdout, done.stdout


@pytest.mark.workflow
def test_ranges_have_shares_and_all_cases_a_table(fresh):
    rough = {key: value for key, value in STEEL.items() if key != "mu"} | {"phi_deg": "14:18"}
    cases = [
        {**rough, "name": "ranged", "delta_deg": "38+-2", "half_angle_deg": 32},
        {**STEEL, "name": "beyond", "mu": 0.48, "description": "too rough"},
    ]
    fresh.set("cases", cases)
    fresh.build("results/cases.csv", "figures/case_ranged.png")
    with (fresh.path / "results/cases.csv").open(newline="", encoding="utf-8") as file:
        ranged, beyond = csv.DictReader(file)
    spare = "Mass flow: yes, with 0.796 deg of half angle to spare; in 65 % of the given range."
    assert ranged["sentence"] == spare
    assert (ranged["delta_deg"], ranged["phi_deg"]) == ("38+-2", "14:18")
    data = reading.read(fresh.path / "results/cases/ranged.nc")
    assert ranged["shares"] == data.shares
    assert "no radial solution: 31 +- 1 % of the range" in data.shares
    assert float(ranged["abscissa"]) == float(data.abscissa)
    assert beyond["verdict"] == "no_radial_solution"
    assert beyond["abscissa"] == ""
    assert "the largest friction that has one is" in beyond["reason"]


@pytest.mark.workflow
def test_a_new_case_makes_its_own_artifact_and_page_only(rebuilt, config):
    rebuilt.set("cases", [*config["cases"], {**STEEL, "name": "rough", "mu": 0.31}])
    assert rebuilt.reruns() == {"compute_case/rough", "plot_case/rough", "summarise_cases"}
    rebuilt.set("cases", [{**config["cases"][0], "description": "another"}])
    assert rebuilt.reruns() == {"plot_case/steel_cone"}
    rebuilt.set("cases", [])
    assert rebuilt.reruns() == set()


BAD = [
    ({"name": "Steel"}, r"'cases\[1\].name': 'Steel' does not match"),
    ({"name": "../steel"}, r"'cases\[1\].name': '../steel' does not match"),
    ({"name": "a/b"}, r"'cases\[1\].name'"),
    ({"name": "a b"}, r"'cases\[1\].name'"),
    ({"name": "a;rm"}, r"'cases\[1\].name'"),
    ({"name": "rough\n"}, r"'cases\[1\].name'"),
    ({"name": "{wildcard}"}, r"'cases\[1\].name'"),
    ({"name": "é"}, r"'cases\[1\].name'"),
    ({"name": ""}, r"'cases\[1\].name'"),
    ({"name": "a" * 42}, r"'cases\[1\].name'"),
    ({"name": 7}, r"'cases\[1\].name': 7 is not of type 'string'"),
    ({"name": "steel_cone"}, r"'cases\[1\].name': the figure case_steel_cone is taken by cases"),
    ({"description": "long" * 31}, r"'cases\[1\].description': .* is too long"),
    ({"description": "two\nlines"}, r"'cases\[1\].description'"),
    ({"description": "{{ config }}"}, r"'cases\[1\].description'"),
    ({"description": "`code`"}, r"'cases\[1\].description'"),
    ({"geometry": "sphere"}, r"'cases\[1\].geometry': 'sphere' is not one of"),
    ({"geometry": "wedge", "model": "von-mises"}, r"'cases\[1\].model': von-mises is formulated"),
    ({"delta_deg": 90}, r"'cases\[1\].delta_deg': 90 is greater than or equal"),
    ({"half_angle_deg": 0}, r"'cases\[1\].half_angle_deg': 0 is less than or equal"),
    ({"mu": -0.1}, r"'cases\[1\].mu': -0.1 is less than the minimum"),
    ({"mu": float("nan")}, r"'cases\[1\].mu' is nan: give a finite number"),
    ({"mu": 0.85}, r"'cases\[1\].mu': wall friction angle phi = 40.3645 deg has no wall angle"),
    ({"phi_deg": 10}, r"'cases\[1\].mu': give one of mu and phi_deg, not both"),
    ({"delta_deg": "40:36"}, r"'cases\[1\].delta_deg': '40:36' is upside down: give the smaller"),
    ({"delta_deg": "38"}, r"'cases\[1\].delta_deg': '38' does not match"),
    ({"delta_deg": "30:60:1"}, r"'cases\[1\].delta_deg': '30:60:1' does not match"),
    ({"half_angle_deg": "0:20"}, r"'cases\[1\].half_angle_deg': '0:20' crosses a limit"),
    ({"delta_deg": "30:40", "mu": "0.5:0.6"}, r"'cases\[1\].mu': wall friction angle phi = 30.96"),
]


@pytest.mark.parametrize(("change", "message"), BAD)
def test_a_bad_case_is_named(config, change, message):
    config["cases"].append({**STEEL, "name": "rough", **change})
    with pytest.raises(configuration.ConfigurationError, match=message) as caught:
        configuration.check(config, SCHEMA)
    assert "\n" not in str(caught.value)


def test_a_case_lacks_a_key(config):
    del config["cases"][0]["mu"]
    with pytest.raises(
        configuration.ConfigurationError, match=r"'cases\[0\].mu': give one of mu and phi_deg$"
    ):
        configuration.check(config, SCHEMA)


@pytest.mark.parametrize("cases", [None, {}, "steel", [7]])
def test_what_is_no_list_of_cases(config, cases):
    config["cases"] = cases
    with pytest.raises(configuration.ConfigurationError, match="'cases"):
        configuration.check(config, SCHEMA)


def test_no_cases_are_as_good(config):
    config["cases"] = []
    configuration.check(config, SCHEMA)
