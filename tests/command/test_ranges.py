"""Ranges and steps of options: 38+-2, 36:40, 30:60:1."""

import csv
import json
from io import StringIO
from itertools import pairwise

import pytest

CONE = "--geometry cone --delta 40 --half-angle 34"


def test_intervals_keep_the_names_of_plain_answers(answer):
    plain = answer(f"radial {CONE} --phi 14")
    found = answer(f"radial {CONE} --phi 13:14")
    for key in plain.keys() - {"sentence", "notes", "errors", "limit_end", "error_estimate"}:
        assert key in found, key
    for key in ("sigma_axis", "psi_wall", "psi_wall_deg", "flow_factor", "u_wall"):
        low, high = found[key]
        assert min(abs(low - plain[key]), abs(high - plain[key])) < 1e-9, key
        assert len(found["errors"][key]) == 2
    assert found["phi_deg"] == [13, 14]
    assert found["delta_deg"] == 40
    assert found["solutions"] is None
    assert found["probability"] is None
    assert found["share"]["radial_solution"] == 1


def test_shares_and_probabilities(answer):
    found = answer(f"stability {CONE} --phi 14+-2 --normal")
    # The wall slips up to 14.768435 deg, in closed form.
    share, error = found["share"]["mass_flow"], found["share_error"]["mass_flow"]
    assert abs(share - 2.768435 / 4) <= error < 0.01
    chance, error = found["probability"]["mass_flow"], found["probability_error"]["mass_flow"]
    assert abs(chance - 0.649562) <= 2 * error < 0.02
    assert found["sentence"] == (
        "Mass flow: yes, with 1.01 deg of half angle to spare; in 69 % of the given range, with a "
        "probability of 65 %."
    )
    verdicts = {name: share for name, share in found["share"].items() if name != "mass_flow"}
    assert sum(verdicts.values()) == pytest.approx(1, abs=1e-12)


def test_numerical_error_and_range_are_told_apart(run):
    code, out, _ = run("radial --geometry wedge --delta 40+-2 --phi 16 --half-angle 20")
    assert code == 0
    assert out.splitlines()[0] == (
        "Mass flow: yes, radial flow reaches the wall wherever it exists; in more than 99 % of the "
        "given range."
    )
    assert "delta 38 to 42 deg" in out
    assert "'to': what the given range leaves open" in out
    assert "'+-': numerical error" in out


def test_a_design_keeps_its_margin_in_the_whole_range(answer):
    found = answer("design --geometry cone --delta 38+-2 --phi 16")
    low, high = found["half_angle_classical_deg"]
    assert low == pytest.approx(32.37010982510851, abs=1e-9)  # of delta = 40 deg
    assert high == pytest.approx(33.28073357788772, abs=1e-9)  # of 36
    assert found["half_angle_recommended_whole_deg"] == pytest.approx(low - 3, abs=1e-12)
    assert found["sentence"].startswith("Mass flow: up to a half angle of 32.37 to 33.28 deg")
    assert found["half_angle_velocity_deg"] is None


def test_steps_are_rows_of_a_table(run, answer):
    code, out, _ = run("stability --geometry wedge --delta 40:50:10 --mu 0.3 --half-angle 20:30:5")
    rows = list(csv.DictReader(StringIO(out)))
    assert code == 0
    places = [(row["delta"], row["half-angle"]) for row in rows]
    assert places == [(d, h) for d in ("40.0", "50.0") for h in ("20.0", "25.0", "30.0")]
    plain = answer("stability --geometry wedge --delta 50 --mu 0.3 --half-angle 25")
    assert rows[4]["sentence"] == plain["sentence"]
    assert rows[4]["verdict"] == plain["verdict"]
    assert float(rows[4]["abscissa"]) == pytest.approx(plain["abscissa"], abs=1e-9)


def test_steps_as_json_and_in_a_file(run, tmp_path):
    command = "radial --geometry cone --delta 40 --phi 16:40:8 --half-angle 20"
    _, out, _ = run(f"{command} --json")
    rows = json.loads(out)
    assert [row["phi"] for row in rows] == [16, 24, 32, 40]
    assert rows[0]["verdict"] == "stable"
    assert "the largest friction that has one" in rows[-1]["reason"]
    path = tmp_path / "rows.json"
    code, said, _ = run(f"{command} --out {path}")
    assert (code, said) == (0, f"4 rows in {path}.\n")
    assert json.loads(path.read_text(encoding="utf-8")) == rows
    code, _, err = run(f"{command} --out {path}")
    assert code == 2
    assert "--force to overwrite" in err


def test_steps_of_a_design(run, answer):
    _, out, _ = run("design --geometry cone --delta 40 --phi 16:46:30")
    first, last = csv.DictReader(StringIO(out))
    plain = answer("design --geometry cone --delta 40 --phi 16")
    assert first["sentence"] == plain["sentence"]
    assert float(first["flow_factor"]) == pytest.approx(plain["flow_factor"], rel=1e-12)
    assert "transmits at most phi = 40 deg" in last["reason"]


BAD = [
    ("--delta 38+-", "argument --delta: '38+-': '' is not a number: give a number, 38+-2"),
    ("--delta +-2", "'' is not a number"),
    ("--delta 38+-2+-1", "has +- twice"),
    ("--delta 38+--2", "what follows +- is negative"),
    ("--delta 40:36", "'40:36' is upside down: give the smaller end first, 36:40"),
    ("--delta 38,5", "with a decimal point"),
    ("--delta 38,5:40", "'38,5' is not a number"),
    ("--delta nan:40", "nan is not finite"),
    ("--delta 36:inf", "inf is not finite"),
    ("--delta 85+-6", "crosses a limit: 91.0 is out of range: give degrees between 0 and 90"),
    ("--delta 0:40", "crosses a limit: 0.0 is out of range"),
    ("--half-angle 0:20", "argument --half-angle: '0:20' crosses a limit"),
    ("--phi 1+-2", "argument --phi: '1+-2' crosses a limit: -1.0"),
    ("--delta 30:60:0", "the step is zero"),
    ("--delta 30:60:-1", "leads away from the stop: give 30:60:1"),
    ("--delta 30:60:1e-9", "more than 10000 steps"),
    ("--delta 1:2:3:4", "too many colons"),
    ("--delta 36:40 --phi 10:20:1", "do not go together"),
    ("--delta 36:40 --normal", "give 38+-2"),
    ("--normal", "argument --normal: no option has a range"),
    ("--delta 36:40 --plot a.png", "argument --plot: there is one of one hopper only"),
    ("--delta 36:40 --out a.csv", "argument --out: is for a table"),
    ("--delta 1:80:0.1 --half-angle 1:80:0.1", "rows are more than 10000"),
]


@pytest.mark.parametrize(("options", "message"), BAD)
def test_what_is_refused_before_any_work(run, no_computation, options, message):
    given = {"--delta": "40", "--half-angle": "20", "--phi": "10"}
    words = options.split()
    given |= {key: value for key, value in pairwise(words) if key.startswith("--")}
    flags = ["--normal"] * (given.pop("--normal", None) is not None or "--normal" in words)
    parts = [f"{key}={value}" for key, value in given.items()]
    code, out, err = run(" ".join(["radial --geometry cone", *parts, *flags]))
    assert (code, out) == (2, "")
    assert message in err
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize(
    ("command", "message"),
    [
        (
            "radial --geometry cone --delta 30:40 --phi 29+-2 --half-angle 20",
            "argument --phi: its range ends above 30 deg, the most that a Mohr-Coulomb material "
            "with delta = 30 deg transmits",
        ),
        (
            "design --geometry cone --delta 30:40 --mu 0.5:0.6",
            "argument --mu: its range ends above 0.57735",
        ),
        (
            "stability --geometry cone --model von-mises --delta 30:40 --mu 0.1 --half-angle 20",
            "argument --model: the stability of von Mises cones is not looked at over a range",
        ),
        ("march --geometry cone --delta 30:40 --mu 0.1 --half-angle 20", "'30:40' is not a number"),
    ],
)
def test_ranges_of_impossible_hoppers(run, command, message):
    code, out, err = run(command)
    assert (code, out) == (2, "")
    assert message in err
    assert len(err.splitlines()) == 1
