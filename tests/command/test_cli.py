"""The command `hopper`: answers, files, errors, and what it does not import."""

import csv
import json
import os
import re
import shlex
import subprocess
import sys
from math import atan, degrees, radians
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from hopper import Hopper, __version__
from hopper.assessment.radial import assess_radial
from hopper.assessment.stability import assess_stability
from hopper.errors import ConvergenceError, not_resolved_because
from hopper_cli import about, commands, text
from hopper_cli.main import EXAMPLES

HOPPER = str(Path(sys.executable).with_name("hopper"))
STEEL = "--geometry cone --model mohr-coulomb --delta 40 --half-angle 20 --mu 0.3"
SINGULAR = "--geometry cone --delta 25 --half-angle 30 --mu 0.4"
RADIAL_KEYS = {
    "sigma_axis", "sigma_wall", "psi_wall", "psi_max", "u_wall", "flow_factor", "mu_fold",
    "psi_wall_deg", "psi_max_deg",
    "mass_flow_limit_deg", "error_estimate",
}  # fmt: skip
STABILITY_KEYS = {
    "eigenvalues", "asymmetric_eigenvalues", "line", "abscissa", "abscissa_symmetric",
    "abscissa_asymmetric", "governed_by", "parity", "verdict", "disturbances", "error_estimate",
    "kappa", "transient_growth", "transient_amplification", "transient_modes", "mu_tangency",
}  # fmt: skip
WEDGE = "--geometry wedge --delta 40 --half-angle 20 --phi 25"


def steel():
    return assess_radial(Hopper("cone", radians(40), radians(20)), atan(0.3))


# --- answers -------------------------------------------------------------------------------------


def test_radial(answer):
    found = answer(f"radial {STEEL}")
    assert set(found) >= RADIAL_KEYS
    expected = steel()
    for key in ("sigma_axis", "sigma_wall", "psi_wall", "psi_max", "u_wall", "flow_factor"):
        quantity = getattr(expected, key)
        assert found[key] == quantity.value
        assert found["errors"][key] == quantity.error
    assert found["mu_fold"] == found["mu_limit"] == expected.limits.coefficient.value
    assert found["limit_end"] == "fold"
    assert found["mass_flow_limit_deg"] == pytest.approx(degrees(expected.limits.mass_flow.value))
    assert found["solutions"] == 1
    assert found["notes"] == []
    inputs = ("geometry", "model", "delta_deg", "half_angle_deg", "mu")
    assert [found[key] for key in inputs] == ["cone", "mohr-coulomb", 40, 20, 0.3]
    assert found["phi_deg"] == pytest.approx(degrees(atan(0.3)), abs=1e-13)


def test_the_error_estimate_of_radial_is_the_largest_relative_one(answer):
    found = answer(f"radial {STEEL}")
    errors = found["errors"]
    psi = {"psi_wall", "psi_max", "psi_wall_deg", "psi_max_deg"}
    keys = RADIAL_KEYS - psi - {"error_estimate", "mass_flow_limit_deg"}
    relative = [errors[key] / found[key] for key in keys]
    relative += [errors["psi_wall"], errors["psi_max"], radians(errors["theta_psi_max_deg"])]
    assert found["error_estimate"] == pytest.approx(
        max(*relative, radians(errors["mass_flow_limit_deg"]))
    )


def test_stability(answer):
    found = answer(f"stability {STEEL}")
    assert set(found) >= STABILITY_KEYS
    solution = steel().solution
    expected = assess_stability(solution)
    eigenvalues = np.array(found["eigenvalues"]) @ [1, 1j]
    np.testing.assert_array_equal(eigenvalues, expected.result.eigenvalues)
    assert eigenvalues.size == 6
    assert np.all(eigenvalues.imag >= 0)
    assert np.all(np.diff(np.abs(eigenvalues)) > 0)
    assert len(found["errors"]["eigenvalues"]) == eigenvalues.size
    assert found["line"] == expected.result.line.abscissa
    assert found["abscissa"] == expected.abscissa.value
    assert found["error_estimate"] == expected.abscissa.error
    assert (found["governed_by"], found["parity"]) == ("complex mode", "symmetric")
    assert (found["verdict"], found["disturbances"]) == ("stable", "symmetric")
    assert found["abscissa_symmetric"] == found["abscissa"]
    assert 1 < found["transient_growth"] < found["transient_amplification"] < found["kappa"]


def test_asymmetric_disturbances_of_a_wedge(answer):
    found = answer(f"stability {WEDGE}")
    assert found["abscissa_symmetric"] == pytest.approx(-0.0872, abs=5e-5)
    assert found["abscissa"] == found["abscissa_asymmetric"] == pytest.approx(0.6649, abs=5e-5)
    assert (found["governed_by"], found["parity"]) == ("complex mode", "asymmetric")
    assert found["verdict"] == "stable_symmetric_only"
    assert found["asymmetric_eigenvalues"][0][0] == found["abscissa"]
    symmetric = answer(f"stability {WEDGE} --disturbances symmetric")
    assert (symmetric["verdict"], symmetric["parity"]) == ("stable", "symmetric")
    assert symmetric["asymmetric_eigenvalues"] is symmetric["abscissa_asymmetric"] is None
    assert symmetric["abscissa"] == found["abscissa_symmetric"]
    assert symmetric["eigenvalues"] == found["eigenvalues"]


@pytest.mark.parametrize("count", [1, 2, 3, 15])
def test_as_many_modes_as_asked_for(answer, count):
    found = answer(f"stability {WEDGE} --modes {count}")
    for key in ("eigenvalues", "asymmetric_eigenvalues"):
        assert len(found[key]) == len(found["errors"][key]) == count
    assert found["verdict"] == "stable_symmetric_only"


def test_beyond_the_tangency_and_up_to_the_limit(answer):
    found = answer("stability --geometry cone --delta 35 --half-angle 30 --mu 0.325")
    assert found["abscissa"] == pytest.approx(-1.04881792, abs=5e-9)
    assert found["mu_tangency"] < 0.325
    limit = answer("radial --geometry cone --delta 35 --half-angle 30 --mu 0.325")["mu_limit"]
    near = answer(f"stability --geometry cone --delta 35 --half-angle 30 --mu {limit - 1e-9}")
    assert -0.1 < near["abscissa"] < 0
    assert near["governed_by"] == "real mode"


def test_neutral_points_and_stable_intervals(answer):
    found = answer("neutral --geometry cone --half-angle 30 --phi 18.5")
    (point,), (interval,) = found["neutral_points"], found["stable_intervals_deg"]
    assert point["delta_deg"] == found["delta_neutral_deg"] == interval["lower"]
    assert point["delta_deg"] == pytest.approx(29.659866122956, abs=1e-9)
    assert (point["governed_by"], point["parity"]) == ("complex mode", "symmetric")
    assert (interval["lower_end"], interval["upper_end"]) == ("neutral", "fold")
    edge = f"--geometry cone --half-angle 30 --delta {interval['upper']}"
    assert answer(f"radial {edge} --phi 10")["mu_limit"] == pytest.approx(found["mu"], abs=1e-9)


def test_no_neutral_point_is_an_answer(answer, run):
    found = answer("neutral --geometry cone --half-angle 10 --phi 30")
    assert found["delta_neutral_deg"] is found["governed_by"] is found["error_estimate"] is None
    assert found["neutral_points"] == []
    (interval,) = found["stable_intervals_deg"]
    assert interval["lower_end"] == "fold"
    assert interval["lower"] == pytest.approx(33.7856, abs=5e-5)
    # 45 deg: no delta at all is stable above the neutral curve's largest phi.
    _, out, err = run("neutral --geometry cone --half-angle 45 --phi 15")
    assert err == ""
    assert out.splitlines()[0] == (
        "No delta is stable to axisymmetric disturbances without swirl at this wall friction."
    )


SOFT = "--geometry cone --model von-mises"
COUPLED_KEYS = {
    "type", "verdict", "eigenvalues", "flow_rate_mode", "strips", "abscissa", "governed_by",
    "decay_down", "decay_up", "slanted", "error_estimate",
}  # fmt: skip
MOHR_COULOMB_ONLY = {
    "line", "kappa", "transient_growth", "transient_amplification", "transient_modes", "parity",
    "abscissa_symmetric", "abscissa_asymmetric", "asymmetric_eigenvalues", "mu_tangency",
}  # fmt: skip


def test_stability_of_an_elliptic_flow(answer, run):
    found = answer(f"stability {SOFT} --delta 25 --half-angle 10 --mu 0.1")
    assert set(found) >= COUPLED_KEYS
    assert {key for key, value in found.items() if value is None} == MOHR_COULOMB_ONLY | {
        "abscissa", "strips", "governed_by", "ring_spacing"
    }  # fmt: skip
    assert (found["type"], found["verdict"], found["slanted"]) == (
        "elliptic",
        "saint_venant",
        False,
    )
    assert found["decay_down"] == pytest.approx(4.553178134, abs=1e-8)
    assert found["decay_up"] == pytest.approx(8.267302196, abs=1e-8)
    assert found["flow_rate_mode"] == 0
    modes = np.array(found["eigenvalues"]) @ [1, 1j]
    assert modes.size == len(found["errors"]["eigenvalues"]) == 6
    assert np.all(np.diff(np.abs(modes)) > 0)
    assert -found["decay_down"] == modes[0]
    _, out, err = run(f"stability {SOFT} --delta 25 --half-angle 10 --mu 0.1")
    assert err == ""
    assert "dies out down the hopper as r^4.553, one at the outlet up the hopper as r^-8.267" in out


def test_stability_of_a_hyperbolic_flow(answer, run):
    found = answer(f"stability {SOFT} --delta 50 --half-angle 10 --mu 0.3")
    assert (found["type"], found["verdict"], found["slanted"]) == ("hyperbolic", "stable", True)
    assert found["abscissa"] == pytest.approx(-0.205312783, abs=1e-8)
    assert found["governed_by"] == "mode"
    assert found["strips"][-1] == pytest.approx([-0.2918375, -0.2902711], abs=1e-6)
    assert found["decay_down"] is found["decay_up"] is None
    assert 0 < found["error_estimate"] < 0.2
    _, out, _ = run(f"stability {SOFT} --delta 50 --half-angle 10 --mu 0.3")
    assert out.splitlines()[-1] == (
        "Stable: axisymmetric disturbances without swirl decay down the hopper, governed by a "
        "mode; that no other mode grows is tested, not proved. Data belong on a slanted surface: "
        "a characteristic lies in r = const."
    )
    assert answer(f"stability {SOFT} --delta 40 --half-angle 30 --mu 0.2")["verdict"] == "unstable"


def test_stability_of_other_von_mises_flows(answer, run):
    mixed = answer(f"stability {SOFT} --delta 30 --half-angle 30 --mu 0.3")
    assert (mixed["type"], mixed["verdict"]) == ("mixed", "mixed")
    assert mixed["sonic_deg"] == [pytest.approx(10.084, abs=1e-3)]
    assert mixed["ring_spacing"] == pytest.approx(15.65, abs=5e-3)
    assert mixed["eigenvalues"][0] == pytest.approx([1.200984925, 5.286138402], abs=1e-8)
    assert mixed["abscissa"] is mixed["decay_down"] is mixed["error_estimate"] is None
    tension = answer(f"stability {SOFT} --delta 62 --half-angle 10 --mu 0.1")
    assert (tension["verdict"], tension["eigenvalues"]) == ("tension", [])
    assert "T_rr <= 0 on the axis" in tension["reason"]
    # Nothing bounds how fast modes that are not resolved grow.
    case = f"stability {SOFT} --delta 35.52 --half-angle 10 --phi 24"
    open_above = answer(case)
    assert open_above["verdict"] == "unstable"
    assert open_above["abscissa"] is open_above["governed_by"] is None
    assert "and modes not resolved may exceed it." in run(case)[1]
    unknown = answer(f"stability {SOFT} --delta 39.435 --half-angle 10 --phi 31.5")
    assert (unknown["verdict"], unknown["abscissa"]) == ("not_converged", None)
    assert run(case.replace("35.52", "39.435").replace("24", "31.5"))[0] == 0
    code, out, err = run(f"stability {SOFT} --delta 50 --half-angle 30 --phi 27.5 --json")
    assert (code, json.loads(out)["error"]["kind"]) == (1, "NoRadialSolutionError")
    assert "psi reaches 45 deg at phi = 26.8994 deg" in err


def test_neutral_of_von_mises_cones(answer):
    # (38 deg, 3.73529625 deg): sup Re(lambda) = 0 by shooting.
    found = answer("neutral --geometry cone --model von-mises --half-angle 10 --phi 3.73529625")
    (point,), (interval,) = found["neutral_points"], found["stable_intervals_deg"]
    assert point["delta_deg"] == found["delta_neutral_deg"] == interval["lower"]
    assert point["delta_deg"] == pytest.approx(38, abs=1e-6)
    assert (point["governed_by"], point["parity"]) == ("mode", "symmetric")
    assert (interval["lower_end"], interval["upper_end"]) == ("neutral", "not_converged")
    assert 59 < interval["upper"] < 60
    none = answer("neutral --geometry cone --model von-mises --half-angle 30 --phi 5")
    assert none["neutral_points"] == none["stable_intervals_deg"] == []


@pytest.mark.parametrize("suffix", ["csv", "nc"])
def test_files_of_a_von_mises_spectrum(run, tmp_path, suffix):
    case = f"stability {SOFT} --delta 40 --half-angle 10 --mu 0.1"
    code, _, err = run(f"{case} --profile {tmp_path}/a.{suffix} --plot {tmp_path}/a.png")
    assert (code, err) == (0, "")
    assert (tmp_path / "a.png").stat().st_size > 5000
    if suffix == "nc":
        data = xr.open_dataset(tmp_path / "a.nc")
        assert float(data.eigenvalue_real[1]) == pytest.approx(-0.01210634, abs=1e-8)
        assert data.strips.shape == (2, 2)
    else:
        header, first, *_ = csv.reader((tmp_path / "a.csv").open())
        assert header[0] == "eigenvalue_real [1]"
        assert float(first[0]) == pytest.approx(-13.594972760577, abs=1e-8)
    code, _, err = run(
        f"stability {SOFT} --delta 62 --half-angle 10 --mu 0.1 --plot {tmp_path}/b.png"
    )
    assert code == 1
    assert "there are no modes to write: delta = 62 deg is 60 deg or more" in err


@pytest.mark.parametrize(("phi", "delta"), [(0, 33.6739), (10, 26.1404)])
def test_neutral(answer, phi, delta):
    found = answer(f"neutral --geometry cone --half-angle 10 --phi {phi}")
    assert found["delta_neutral_deg"] == pytest.approx(delta, abs=5e-5)
    assert found["error_estimate"] == found["errors"]["delta_neutral_deg"] < 1e-8
    assert found["phi_deg"] == phi


def test_friction_as_angle_or_coefficient(answer):
    case = "radial --geometry wedge --delta 35 --half-angle 15"
    angle = answer(f"{case} --phi 10")
    coefficient = answer(f"{case} --mu {angle['mu']!r}")
    assert angle["sigma_wall"] == coefficient["sigma_wall"]
    assert coefficient["phi_deg"] == pytest.approx(10, abs=1e-12)


@pytest.mark.parametrize(
    ("command", "null"),
    [
        (f"radial {SINGULAR}", {"u_wall", "mu_fold"}),
        ("radial --geometry wedge --delta 35 --half-angle 10 --phi 0",
         {"mu_fold", "mass_flow_limit_deg"}),
        ("radial --geometry cone --model von-mises --delta 30 --half-angle 30 --mu 0.2",
         {"mu_fold", "mass_flow_limit_deg", "mu_tangency"}),
        ("stability --geometry wedge --delta 35 --half-angle 10 --phi 0", {"transient_growth"}),
        (f"stability {STEEL}", {"asymmetric_eigenvalues", "abscissa_asymmetric"}),
    ],
)  # fmt: skip
def test_what_does_not_exist_is_null(answer, command, null):
    found = answer(command)
    assert {key for key, value in found.items() if value is None} == null
    assert not null & set(found["errors"])
    if "u_wall" in null:
        assert "velocity is singular: psi reaches pi/4 at theta" in found["notes"][0]


def test_text_for_people(run):
    code, out, err = run(f"radial {STEEL}")
    assert (code, err) == (0, "")
    assert out.startswith("Mass flow: yes, with 11.4 deg of half angle to spare.\n\n")
    assert "\nRadial solution: cone, mohr-coulomb, delta 40 deg, half angle 20 deg" in out
    assert re.search(r"average stress at the wall +0\.2603136708 \+- \de-14 rho g r\n", out)
    assert re.search(r"mass-flow limit of phi +25\.00866408 \+- \de-1\d deg\n", out)
    assert out.splitlines()[-1] == (
        "A radial solution exists up to mu = 0.468082, where a second branch of solutions begins; "
        "the wall is within the mass-flow limit, phi = 25.0087 deg."
    )
    _, out, _ = run(f"stability {STEEL}")
    assert re.search(r"eigenvalue 2 +-4\.36772238\d* \+ 17\.3433765\d*i \+- ", out)
    assert out.splitlines()[-1] == (
        "Stable: axisymmetric disturbances without swirl decay down the hopper, governed by a "
        "symmetric complex mode."
    )
    _, out, _ = run(f"stability {WEDGE}")
    assert out.splitlines()[-1] == (
        "Stable to symmetric disturbances only: asymmetric ones grow down the hopper, governed by "
        "an asymmetric complex mode."
    )
    _, out, _ = run("neutral --geometry cone --half-angle 10 --phi 10")
    assert out.splitlines()[0] == (
        "Stable to axisymmetric disturbances without swirl where delta is from 26.1404 to 89 deg."
    )


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        (0.123456789012, 2e-14, "0.1234567890 +- 2e-14"),
        (0.123456789012, 3e-5, "0.12346 +- 3e-05"),
        (17.34, 0.04, "17.34 +- 4e-02"),
        (17.34, 40.0, "2e+01 +- 4e+01"),
        (-0.002, 1e-4, "-0.0020 +- 1e-04"),
        (0.0, 1e-15, "0 +- 1e-15"),
        (3, None, "3"),
    ],
)
def test_digits_end_where_the_error_begins(value, error, expected):
    assert text.with_error(value, error) == expected


# --- help ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("command", EXAMPLES)
def test_the_example_in_the_help_runs(run, command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("hoppers.csv").write_text("geometry,delta,half-angle,phi\ncone,40,20,16\n")
    code, out, _ = run(f"{command} --help")
    assert code == 0
    (example,) = re.findall(rf"^  (hopper {command} .*)$", out, re.MULTILINE)
    code, out, err = run(example.removeprefix("hopper "))
    assert (code, err) == (0, "")
    assert "+-" in out or Path("results.csv").is_file() or Path("chart.png").is_file()


def test_version_and_help(run):
    code, out, err = run("--version")
    assert (code, err) == (0, "")
    assert re.fullmatch(rf"hopper {re.escape(__version__)}( \(commit \S+\))?\n", out)
    code, out, _ = run("--help")
    assert code == 0
    assert all(command in out for command in EXAMPLES)


# --- errors --------------------------------------------------------------------------------------

CONE = "--geometry cone --delta 30 --half-angle 30"
USAGE = [
    ("", "the following arguments are required: COMMAND; see hopper --help"),
    ("solve", "invalid choice: 'solve'"),
    ("radial", "required: --geometry, --delta, --half-angle"),
    (f"radial {CONE}", "one of the arguments --mu --phi is required"),
    (f"radial {CONE} --mu 0.1 --phi 5", "argument --phi: not allowed with argument --mu"),
    (f"radial {CONE} --mu 0.1 --typo", "unrecognized arguments: --typo"),
    ("radial --geometry sphere --delta 30 --half-angle 30 --mu 0",
     "argument --geometry: invalid choice: 'sphere' (choose from"),
    ("radial --geometry cone --delta 95 --half-angle 30 --mu 0",
     "argument --delta: 95 is out of range: give degrees between 0 and 90"),
    ("radial --geometry cone --delta nan --half-angle 30 --mu 0",
     "argument --delta: nan is out of range"),
    ("radial --geometry cone --delta steep --half-angle 30 --mu 0",
     "argument --delta: 'steep' is not a number: give degrees"),
    ("radial --geometry cone --delta 30 --half-angle 0 --mu 0",
     "argument --half-angle: 0 is out of range: give degrees between 0 and 90"),
    (f"radial {CONE} --mu -0.1", "argument --mu: -0.1 is out of range: give a number from 0"),
    (f"radial {CONE} --phi 90", "argument --phi: 90 is out of range: give degrees from 0 to"),
    (f"radial {CONE} --phi 31", "argument --phi: wall friction angle phi = 31 deg has no wall"),
    (f"stability {CONE} --mu 0.7", "argument --mu: wall friction angle phi = 34.992 deg has no"),
    ("radial --geometry wedge --model von-mises --delta 30 --half-angle 30 --mu 0",
     "argument --model: von-mises is formulated for cones only: use --geometry cone"),
    ("stability --geometry wedge --model von-mises --delta 30 --half-angle 30 --mu 0",
     "argument --model: von-mises is formulated for cones only: use --geometry cone"),
    ("neutral --geometry wedge --model von-mises --half-angle 30 --mu 0",
     "argument --model: von-mises is formulated for cones only: use --geometry cone"),
    (f"stability {CONE} --model von-mises --mu 0.7", "argument --mu: wall friction angle phi ="),
    (f"march {CONE} --mu 0 --depth 1", "the following arguments are required: --top"),
    (f"march {CONE} --mu 0 --top bump-s --depth 1", "argument --top: bump-s needs --eps"),
    (f"march {CONE} --mu 0 --top linear --eps 0.1 --depth 1", "argument --eps: the top linear has"),
    (f"march {CONE} --mu 0 --top scaled --factor 0 --depth 1",
     "argument --factor: 0 is out of range: give a positive number"),
    (f"march {CONE} --mu 0 --top one-sided --eps 0.1 --depth 1",
     "argument --top: the top of a cone must be symmetric: use bump-s or --geometry wedge"),
    (f"march {CONE} --mu 0 --top bump-s --eps 1e9 --depth 1", "argument --eps: 1e9 is out of"),
    (f"march {CONE} --mu 0 --top none.csv --depth 1", "argument --top: there is no file none.csv"),
    (f"march {CONE} --mu 0 --top flat --depth 1", "argument --top: 'flat' is unknown: use bump-s,"),
    (f"march {CONE} --mu 0 --top bin --depth 0",
     "argument --depth: 0 is out of range: give a positive number up to 700"),
    (f"march {CONE} --mu 0 --top bin --depth 1e4", "argument --depth: 1e4 is out of range: give a"),
    (f"march {CONE} --mu 0 --top bin --depth 1 --at-tau 2",
     "argument --at-tau: 2 is below --depth 1: march deeper"),
    (f"march {CONE} --model von-mises --mu 0 --top bin --depth 1",
     "argument --model: the stress march is formulated for mohr-coulomb only"),
    ("neutral --geometry cone --half-angle 10 --delta 30 --mu 0", "unrecognized arguments"),
    (f"stability {CONE} --mu 0 --disturbances any",
     "argument --disturbances: asymmetric disturbances are singular at the apex of a cone"),
    ("neutral --geometry cone --half-angle 10 --mu 0 --disturbances any",
     "argument --disturbances: asymmetric disturbances are singular at the apex of a cone"),
    (f"stability {CONE} --mu 0 --disturbances odd", "argument --disturbances: invalid choice"),
    (f"stability {CONE} --mu 0 --modes 0",
     "argument --modes: 0 is out of range: give a whole number from 1 to 40"),
    (f"stability {CONE} --mu 0 --modes 2.5", "argument --modes: 2.5 is out of range"),
]  # fmt: skip
NO_ANSWER = [
    (f"radial {CONE} --mu 0.36",
     "no radial solution at phi = 19.7989 deg (mu = 0.36): the largest friction that has one is "
     "phi = 19.7406 deg (mu = 0.358852)"),
    (f"stability {CONE} --mu 0.36", "the largest friction that has one is phi = 19.7406 deg"),
    ("stability --geometry wedge --delta 45 --half-angle 10 --phi 44.999",
     "psi is too close to its singular value, lower the wall friction; the largest friction with a "
     "radial solution is mu = 1"),
    ("radial --geometry cone --delta 8 --half-angle 10 --mu 0", "raise delta"),
    ("neutral --geometry cone --half-angle 45 --phi 40",
     "no cone of half angle 45 deg has a resolved radial solution at phi = 40 deg: lower the"),
]  # fmt: skip


def is_one_error(err, message):
    return err.startswith("hopper: error: ") and err.count("\n") == 1 and message in err


@pytest.mark.parametrize(("command", "message"), USAGE)
def test_a_wrong_option_is_named(run, command, message):
    code, out, err = run(command)
    assert (code, out) == (2, "")
    assert is_one_error(err, message), err


@pytest.mark.parametrize(("command", "message"), NO_ANSWER)
def test_where_there_is_no_answer_the_limit_is_named(run, command, message):
    code, out, err = run(command)
    assert (code, out) == (1, "")
    assert is_one_error(err, message), err


def test_fields_that_do_not_converge(run, monkeypatch):
    def fail(*arguments):
        raise ConvergenceError("radial solution not resolved")

    monkeypatch.setattr("hopper_cli.commands.assess_radial", fail)
    code, out, err = run(f"radial {STEEL}")
    assert (code, out) == (1, "")
    assert is_one_error(err, "not resolved; the largest friction with a radial solution is mu = ")
    monkeypatch.setattr("hopper.assessment.limits.friction_limit", fail)
    code, out, err = run(f"radial {STEEL}")
    assert code == 1
    assert err == "hopper: error: radial solution not resolved\n"


def test_interrupted(run, monkeypatch):
    def interrupt(options):
        raise KeyboardInterrupt

    monkeypatch.setattr(commands, "answer", interrupt)
    assert run(f"radial {STEEL}") == (130, "", "")


# --- files ---------------------------------------------------------------------------------------


def test_fields_as_csv(run, tmp_path):
    path = tmp_path / "fields.csv"
    code, _, err = run(f"radial {STEEL} --profile {path}")
    assert (code, err) == (0, "")
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["theta [degree]", "sigma [rho g r]", "psi [radian]", "u [u(0)]"]
    theta, *columns = np.array(rows, float).T
    found = steel()
    for column, expected in zip(columns, found.profiles(np.radians(theta)), strict=True):
        np.testing.assert_allclose(column, expected, rtol=1e-13, atol=1e-15)
    assert theta[0] == -20
    assert 0 in theta


def test_an_unknown_velocity_is_left_out(run, tmp_path):
    path = tmp_path / "fields.csv"
    assert run(f"radial {SINGULAR} --profile {path}")[0] == 0
    assert path.read_text().splitlines()[0] == "theta [degree],sigma [rho g r],psi [radian]"


def test_eigenvalues_as_csv(run, answer, tmp_path):
    path = tmp_path / "modes.csv"
    low = answer(f"stability {STEEL} --profile {path}")["eigenvalues"]
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["eigenvalue_real [1]", "eigenvalue_imag [1]", "eigenvalue_error [1]"]
    table = np.array(rows, float)
    difference = (table[: len(low), :2] - low) @ [1, 1j]
    assert np.all(np.abs(difference) <= table[: len(low), 2])
    assert len(table) > len(low)
    assert np.all(table[:, 2] > 0)


@pytest.mark.parametrize("command", ["radial", "stability"])
def test_netcdf_follows_the_conventions(run, answer, tmp_path, command):
    path = tmp_path / "out.nc"
    found = answer(f"{command} {STEEL} --profile {path}")
    with xr.open_dataset(path) as data:
        for key, value in data.items():
            assert value.long_name
            assert "units" in value.attrs or "flag_values" in value.attrs
            if "units" in value.attrs and key in found:
                assert float(value) == pytest.approx(found[key], rel=1e-15)
        assert json.loads(data.parameters)["mu"] == 0.3
        assert f"{'sigma_wall' if command == 'radial' else 'abscissa'}_error" in data
    checker = Path(sys.executable).with_name("compliance-checker")
    report = tmp_path / "report.json"
    options = ["--test=cf:1.11", "--format=json", f"--output={report}"]
    done = subprocess.run([checker, *options, path], capture_output=True, text=True, check=False)
    assert report.exists(), done.stderr
    result = json.loads(report.read_text())["cf:1.11"]
    for priority in ("high_priorities", "medium_priorities"):
        assert [item["msgs"] for item in result[priority] if item["msgs"]] == []


MAGIC = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}


@pytest.mark.parametrize(
    ("command", "suffix"),
    [("radial", "png"), ("radial", "pdf"), ("radial", "svg"), ("stability", "svg")],
)
def test_plots_do_not_vary(run, tmp_path, command, suffix):
    first, second = (tmp_path / f"{name}.{suffix}" for name in ("first", "second"))
    for path in (first, second):
        code, out, err = run(f"{command} {STEEL} --plot {path}")
        assert (code, err) == (0, "")
        assert out
    assert first.read_bytes().startswith(MAGIC[suffix])
    assert first.read_bytes() == second.read_bytes()


def test_a_plot_of_an_unknown_velocity(run, tmp_path):
    path = tmp_path / "fields.svg"
    assert run(f"radial {SINGULAR} --plot {path}")[0] == 0


@pytest.mark.usefixtures("no_computation")
@pytest.mark.parametrize(
    ("option", "name", "message"),
    [
        ("--profile", "out.txt", "has no known suffix: use .csv or .nc"),
        ("--profile", "out", "has no known suffix"),
        ("--plot", "out.csv", "has no known suffix: use .png or .pdf or .svg"),
        ("--profile", "missing/out.nc", "does not exist: create it first"),
        ("--plot", "old.png", "exists: give another name, or --force to overwrite it"),
        ("--profile", "folder.nc", "is a folder: give the name of a file"),
        ("--profile", f"{'long' * 70}.nc", "cannot be written: File name too long"),
    ],
)
@pytest.mark.parametrize("command", ["radial", "stability"])
def test_a_file_that_cannot_be_written_is_told_before_the_work(
    run, tmp_path, command, option, name, message
):
    (tmp_path / "old.png").write_text("old")
    (tmp_path / "folder.nc").mkdir()
    before = sorted(tmp_path.iterdir())
    code, out, err = run(f"{command} {STEEL} {option} {tmp_path / name}")
    assert (code, out) == (2, "")
    assert is_one_error(err, message), err
    assert f"argument {option}: " in err
    assert sorted(tmp_path.iterdir()) == before
    assert (tmp_path / "old.png").read_text() == "old"


@pytest.mark.usefixtures("no_computation")
@pytest.mark.skipif(not Path("/proc").is_dir(), reason="needs a folder that nobody can write to")
def test_a_folder_that_cannot_be_written_to(run):
    code, _, err = run(f"radial {STEEL} --profile /proc/out.csv")
    assert code == 2
    assert is_one_error(err, "argument --profile: /proc/out.csv cannot be written: ")


@pytest.mark.usefixtures("no_computation")
def test_a_missing_library_is_named_before_the_work(run, tmp_path, monkeypatch):
    monkeypatch.setattr("hopper_cli.checks.find_spec", lambda name: None)
    code, _, err = run(f"radial {STEEL} --plot {tmp_path / 'out.png'}")
    assert code == 2
    assert is_one_error(
        err, "argument --plot: .png needs matplotlib: install granular-hopper[plot]"
    )
    code, _, err = run(f"radial {STEEL} --profile {tmp_path / 'out.nc'}")
    assert code == 2
    assert is_one_error(err, "argument --profile: .nc needs xarray: install granular-hopper[data]")


@pytest.mark.parametrize("option", ["--profile old.csv", "--profile old.nc", "--plot old.png"])
def test_force_overwrites(run, tmp_path, monkeypatch, option):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / option.split()[1]
    path.write_text("old")
    assert run(f"radial {STEEL} {option}")[0] == 2
    assert run(f"radial {STEEL} {option} --force")[0] == 0
    assert path.read_bytes() != b"old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("suffix", ["csv", "nc"])
def test_a_write_that_fails_leaves_the_old_file(run, tmp_path, monkeypatch, suffix):
    path = tmp_path / f"old.{suffix}"
    path.write_text("old")

    def fail(descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fail)
    code, out, err = run(f"radial {STEEL} --profile {path} --force")
    assert (code, out) == (2, "")
    assert is_one_error(err, "old." + suffix + " cannot be written: ")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_no_answer_leaves_no_file(run, tmp_path):
    code, _, _ = run(f"stability {CONE} --mu 0.36 --profile {tmp_path / 'out.csv'}")
    assert code == 1
    assert list(tmp_path.iterdir()) == []


# --- doubts, refusals ----------------------------------------------------------------------------


RADIANS = "--geometry cone --delta 0.698 --half-angle 0.349"


@pytest.mark.parametrize(
    "command",
    [f"radial {RADIANS} --phi 0.29", f"radial {RADIANS} --mu 0.005", f"stability {RADIANS} --mu 0",
     "neutral --geometry cone --half-angle 0.349 --phi 0.29"],
)  # fmt: skip
def test_radians_are_doubted(run, command):
    code, out, err = run(f"{command} --json")
    assert "all angles are below 1.6 degrees: are they in radians? give degrees" in err + out
    if code == 0:
        assert err.startswith("hopper: warning: all angles")
        assert "are they in radians" in json.loads(out)["notes"][0]


@pytest.mark.parametrize(
    "command", [f"radial {STEEL}", "neutral --geometry cone --half-angle 1 --mu 0.3"]
)
def test_degrees_are_not_doubted(run, command):
    assert "warning" not in run(command)[2]


def test_a_coefficient_that_looks_like_an_angle(run):
    for command in ("radial", "stability"):
        code, _, err = run(f"{command} {CONE} --mu 16.7")
        assert code == 2
        assert is_one_error(err, "was --phi 16.7 meant?")
    code, _, err = run("radial --geometry wedge --delta 80 --half-angle 20 --mu 3")
    assert code == 0
    assert err == ("hopper: warning: --mu 3 is a coefficient: was --phi 3 meant?\n")


def test_numbers_in_a_refusal_differ(run, answer):
    limit = answer(f"radial {CONE} --mu 0.3")["mu_limit"]
    _, _, err = run(f"radial {CONE} --mu {limit * (1 + 1e-12)!r}")
    numbers = re.findall(r"mu = ([\d.]+)\)", err)
    assert len(numbers) == len(set(numbers)) == 2
    assert float(numbers[0]) > float(numbers[1])
    _, _, err = run("radial --geometry wedge --delta 40 --half-angle 20 --phi 40.0000001")
    numbers = re.findall(r"phi = ([\d.]+) deg", err)
    assert len(numbers) == len(set(numbers)) == 2


def test_advice_fits_the_cause(run, monkeypatch):
    def fail(*_):
        raise ConvergenceError(f"not resolved; {not_resolved_because(0.0)}")

    monkeypatch.setattr("hopper_cli.commands.assess_neutral", fail)
    _, _, err = run("neutral --geometry cone --half-angle 89 --phi 0")
    assert is_one_error(err, "take another one")
    assert "lower the wall friction" not in err
    assert "lower the wall friction" in not_resolved_because(0.1)


@pytest.mark.parametrize(
    ("command", "code", "kind"),
    [
        (f"radial {CONE} --mu 0.36", 1, "NoRadialSolutionError"),
        (f"stability {CONE} --mu 0.36", 1, "NoRadialSolutionError"),
        (f"radial {CONE} --mu 5", 2, "UsageError"),
        (f"radial {CONE} --mu x", 2, "UsageError"),
        ("neutral --geometry cone --half-angle 45 --phi 40", 1, "NoRadialSolutionError"),
    ],
)
def test_without_an_answer_json_has_the_error(run, command, code, kind):
    found, out, err = run(f"{command} --json")
    assert found == code
    assert json.loads(out) == {
        "error": {"kind": kind, "message": err.removeprefix("hopper: error: ").rstrip("\n")}
    }


def test_the_help_says_what_the_half_angle_is_measured_from(run):
    assert "half opening angle, from the vertical" in " ".join(run("radial --help")[1].split())


def test_angles_in_degrees_beside_radians(answer, run):
    found = answer(f"radial {STEEL}")
    for key in ("psi_wall", "psi_max"):
        assert found[f"{key}_deg"] == pytest.approx(degrees(found[key]), rel=1e-15)
        assert found["errors"][f"{key}_deg"] == pytest.approx(degrees(found["errors"][key]))
    assert " rad" not in run(f"radial {STEEL}")[1].replace("radial", "")


# --- the installed command -----------------------------------------------------------------------


def loaded_by(command):
    """Top-level packages that a command imports."""
    code = f"""
import sys
from hopper_cli.main import main
assert main({shlex.split(command)!r}) == 0
print(*{{name.split('.')[0] for name in sys.modules}}, file=sys.stderr)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stderr.split())


@pytest.mark.parametrize("command", [f"radial {STEEL}", f"stability {STEEL} --json"])
def test_a_plain_answer_imports_no_more_than_it_needs(command):
    loaded = loaded_by(command)
    assert "scipy" in loaded
    assert not loaded & {
        "matplotlib",
        "xarray",
        "netCDF4",
        "pandas",
        "snakemake",
        "hopper_workflow",
    }


def test_help_imports_no_numerics():
    assert not loaded_by("radial --help") & {"numpy", "scipy"}


def test_the_version_names_the_commit_of_a_clone(tmp_path):
    git = ["git", "-C", str(tmp_path), "-c", "user.name=n", "-c", "user.email=e"]
    assert about.commit(tmp_path) == ""
    for command in (["init", "-q"], ["commit", "-q", "--allow-empty", "-m", "first"]):
        subprocess.run([*git, *command], check=True)
    assert re.fullmatch(r" \(commit [0-9a-f]{12}\)", about.commit(tmp_path))


@pytest.mark.parametrize("shell", about.SHELLS)
def test_shells_complete_commands_and_options(run, shell):
    pytest.importorskip("shtab")
    code, out, _ = run(f"--print-completion {shell}")
    assert code == 0
    for word in ("radial", "chart", "half-angle", "geometry", "von-mises"):
        assert word in out


def test_the_installed_command():
    command = [HOPPER, *shlex.split(f"radial {STEEL} --json")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout)["limit_end"] == "fold"
    assert done.stderr == ""
    bad = subprocess.run([HOPPER, "radial"], capture_output=True, text=True, check=False)
    assert (bad.returncode, bad.stdout) == (2, "")


def test_a_reader_that_goes_away_is_no_error():
    command = [HOPPER, *shlex.split(f"radial {STEEL}")]
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (141, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device without space")
def test_an_answer_that_cannot_be_printed_is_an_error():
    command = [HOPPER, *shlex.split(f"radial {STEEL}")]
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1
    assert is_one_error(done.stderr, "standard output: No space left on device")
