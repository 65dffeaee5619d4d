"""The command `hopper march`: breakdown, fields, tops of one's own, files."""

import csv
from math import exp

import numpy as np
import pytest

from hopper_data import open_artifact

WEDGE = "march --geometry wedge --delta 45 --half-angle 15 --mu 0.2"
CONE = "march --geometry cone --delta 38 --half-angle 17 --mu 0.12"
HOPPER = "--geometry wedge --delta 45 --half-angle 15 --mu 0.2"


def test_a_crossing(answer):
    """Published: tau_b = .313278 +- 5e-7 at .421."""
    found = answer(f"{WEDGE} --top bump-s --eps 0.2 --depth 1 --at-tau 0.1")
    assert found["breakdown_tau"] == pytest.approx(0.313278, abs=2e-6)
    assert found["breakdown_error"] == found["errors"]["breakdown_tau"] < 1e-5
    assert found["breakdown_x"] == pytest.approx(0.421, abs=1e-3)
    assert found["breakdown_radius"] == pytest.approx(exp(-found["breakdown_tau"]))
    assert (found["breakdown_kind"], found["tangency_tau"]) == ("crossing", None)
    assert found["settled_5_percent"] is found["settled_1_percent"] is None
    assert found["end_tau"] == pytest.approx(found["breakdown_tau"], rel=0.02)
    assert found["errors"]["sigma_axis"] < 1e-5 < found["error_estimate"]
    assert found["notes"] == [
        f"the march ends at tau = {found['end_tau']:.6g}: nothing below is computed"
    ]


def test_fields_before_a_breakdown(answer):
    found = answer(f"{CONE} --top bump-s --eps 0.2 --depth 0.25 --at-tau 0.25")
    expected = {
        "sigma_axis": 0.277832749,
        "sigma_half": 0.278621080,
        "sigma_wall": 0.309538089,
        "psi_half": 0.091739771,
    }
    assert found["error_estimate"] < 1e-4
    for key, value in expected.items():
        assert found[key] == pytest.approx(value, abs=found["errors"][key])
    assert found["breakdown_kind"] is None
    asked = {key: found[key] for key in ("top", "eps", "factor", "depth", "at_tau")}
    assert asked == {"top": "bump-s", "eps": 0.2, "factor": None, "depth": 0.25, "at_tau": 0.25}


def test_settled_radii_in_words(run):
    code, out, err = run(f"{WEDGE} --top scaled --factor 0.8 --depth 1.8")
    assert (code, err) == (0, "")
    assert "a kink of the stress runs down from it" in out
    assert out.splitlines()[-1] == (
        "No breakdown down to tau = 1.8 (r = 0.165 r_top). The stress is within 5 % of the radial "
        "field from r = 0.785 r_top on and within 1 % of the radial field from r = 0.47 r_top on."
    )


def test_nothing_is_given_behind_a_breakdown(answer):
    found = answer(f"{WEDGE} --top bin --depth 1 --at-tau 0.5")
    assert found["breakdown_kind"] == "crossing"
    assert 1 - found["breakdown_radius"] == pytest.approx(0.005, abs=5e-4)
    assert found["sigma_axis"] is found["psi_half"] is found["settled_5_percent"] is None
    assert "there is no stress at tau = 0.5: the march ends before" in found["notes"]


def test_a_tangency_is_no_crossing(answer):
    """Where theta_w exceeds delta a light top turns over."""
    found = answer(
        "march --geometry wedge --delta 25 --half-angle 45 --mu 0.15 --top bump-s --eps -2 "
        "--depth 1"
    )
    assert (found["breakdown_kind"], found["breakdown_tau"]) == ("tangency", None)
    assert found["tangency_tau"] == pytest.approx(0.056, abs=1e-3)


def test_one_side_of_a_wedge(answer):
    found = answer(f"{WEDGE} --top one-sided --eps 0.2 --depth 0.2")
    assert found["breakdown_tau"] == pytest.approx(0.087312, abs=5e-6)
    assert found["breakdown_x"] == pytest.approx(-0.247, abs=2e-3)


def test_beyond_the_tangency_time_is_tilted(answer):
    found = answer(
        "march --geometry cone --delta 35 --half-angle 10 --mu 0.48 --top bump-s --eps 0.2 "
        "--depth 0.1 --at-tau 0.1"
    )
    assert found["tilted"]
    assert found["sigma_axis"] == pytest.approx(0.0556068664, abs=1e-8)
    assert found["psi_half"] == pytest.approx(0.4907536875, abs=1e-8)
    assert any("tau is tilted" in note for note in found["notes"])


# --- tops of one's own ---------------------------------------------------------------------------


@pytest.fixture
def radial(run, tmp_path):
    """The profile that `hopper radial` writes: a top that stays as it is."""
    path = tmp_path / "radial.csv"
    assert run(f"radial {HOPPER} --profile {path}")[0] == 0
    return path


@pytest.mark.parametrize("suffix", [".csv", ".nc"])
def test_the_radial_field_as_a_file_stays(answer, run, tmp_path, suffix):
    path = tmp_path / f"radial{suffix}"
    assert run(f"radial {HOPPER} --profile {path}")[0] == 0
    found = answer(f"{WEDGE} --top {path} --depth 1.2")
    assert found["breakdown_kind"] is None
    assert found["settled_1_percent"] == 1.0


def changed(path, change):
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    with path.open("w", newline="") as file:
        csv.writer(file).writerows(change(header, rows))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda h, rows: [["angle", *h[1:]], *rows], "has no column theta: give one"),
        (lambda h, rows: [["theta [rad]", *h[1:]], *rows], "must reach the walls"),
        (lambda h, rows: [["theta [gon]", *h[1:]], *rows], "theta is in 'gon': give it in degree"),
        (lambda h, rows: [h, *rows[:5], [rows[5][0], "nan", *rows[5][2:]], *rows[6:]],
         "sigma in row 6 is not finite: remove the row"),
        (lambda h, rows: [h, *rows[:5], [rows[5][0], "high", *rows[5][2:]], *rows[6:]],
         "sigma in row 6 is 'high': give a number in every row"),
        (lambda h, rows: [h, *rows[:5], rows[5][:2], *rows[6:]], "psi in row 6 is missing"),
        (lambda h, rows: [h, *rows[::-1]], "theta of a profile must be increasing"),
        (lambda h, rows: [h, *rows[:-9]], "must reach the walls, half_angle = 15 deg"),
        (lambda h, rows: [h, *([r[0], r[1], str(0.9 * float(r[2])), *r[3:]] for r in rows)],
         "breaks the wall law: it must be"),
        (lambda h, rows: [h, *([r[0], "-" + r[1], *r[2:]] for r in rows)], "is not positive"),
        (lambda h, rows: [], "has no column theta"),
    ],
)  # fmt: skip
def test_bad_tops_end_in_one_line(run, radial, change, words):
    changed(radial, change)
    code, out, err = run(f"{WEDGE} --top {radial} --depth 1")
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1


def test_files_that_are_no_tables(run, tmp_path):
    path = tmp_path / "top.csv"
    path.write_bytes(b"\xff\xfe\x00")
    assert run(f"{WEDGE} --top {path} --depth 1")[0] == 2
    path = tmp_path / "top.nc"
    path.write_text("theta,sigma,psi")
    code, _, err = run(f"{WEDGE} --top {path} --depth 1")
    assert (code, err.count("\n")) == (2, 1)
    assert "cannot be read" in err


def test_a_top_beyond_the_tangency_is_refused(run):
    code, out, err = run(f"{CONE} --top bump-a --eps 3 --depth 1")
    assert (code, out) == (1, "")
    assert "is beyond the tangency" in err
    assert err.count("\n") == 1


# --- files ---------------------------------------------------------------------------------------


def test_profile_and_plot(run, tmp_path):
    table, data, plot = (tmp_path / f"march.{suffix}" for suffix in ("csv", "nc", "png"))
    march = f"{WEDGE} --top bump-s --eps 0.1 --depth 0.2"
    assert run(f"{march} --profile {table} --plot {plot}")[0] == 0
    assert run(f"{march} --profile {data}")[0] == 0
    with table.open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["tau [1]", "theta [degree]", "sigma [rho g r]", "psi [radian]"]
    stored = open_artifact(data)
    assert stored.sigma.dims == ("tau", "theta")
    np.testing.assert_array_equal(np.array(rows, dtype=float)[:, 2], stored.sigma.values.ravel())
    assert float(stored.theta[-1]) == pytest.approx(15)
    assert "breakdown_kind" not in stored
    assert plot.stat().st_size > 10_000
