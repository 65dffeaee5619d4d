"""`hopper design`, and the first line of all answers."""

import json

import pytest

from hopper_data import glossary

STEEL = "--geometry cone --delta 40 --phi 16"
LIMITS = ("classical", "limit", "velocity", "stability", "recommended")
KEYS = {
    *(f"half_angle_{name}_deg" for name in LIMITS),
    *("flow_factor", "velocity_ratio", "critical_stress_kpa", "outlet_m"),
}


def test_keys_errors_and_reasons(run):
    code, out, _ = run(f"design {STEEL} --json")
    found = json.loads(out)
    assert code == 0
    assert set(found) >= KEYS | {f"{key}_error" for key in KEYS}
    for key in KEYS:
        assert (found[key] is None) == (found[f"{key}_error"] is None), key
    assert found["governed_by"] == "classical"
    assert found["half_angle_recommended_deg"] == pytest.approx(
        found["half_angle_classical_deg"] - 3, abs=1e-12
    )
    # Reasons by the name of the limit.
    assert any(note.startswith("velocity: ") for note in found["notes"])


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        (
            f"design {STEEL} --margin 5",
            "Mass flow: up to a half angle of 32.37 deg; recommended 27.37 deg, 5 deg below the "
            "classical limit of mass flow.",
        ),
        (
            f"radial {STEEL} --half-angle 30",
            "Mass flow: yes, with 2.37 deg of half angle to spare.",
        ),
        (
            f"stability {STEEL} --half-angle 30",
            "Mass flow: yes, with 2.37 deg of half angle to spare.",
        ),
        (
            f"radial {STEEL} --half-angle 32.5",
            "Mass flow: no, the half angle is 0.13 deg too large.",
        ),
        (
            "radial --geometry wedge --delta 30 --phi 12 --half-angle 20",
            "Mass flow: yes, radial flow reaches the wall wherever it exists.",
        ),
    ],
)
def test_the_first_line_is_the_answer(run, command, sentence):
    code, out, _ = run(command)
    assert code == 0
    assert out.splitlines()[0] == sentence


def test_outlet_of_a_measured_flow_function(run, tmp_path):
    path = tmp_path / "powder.csv"
    rows = "\n".join(f"{s},{0.5 + 0.3 * s}" for s in (0.5, 2, 5, 9))
    path.write_text(f"sigma_1,f_c\n{rows}\n", encoding="utf-8")
    _, measured, _ = run(f"design {STEEL} --json --bulk-density 900 --flow-function {path}")
    _, straight, _ = run(
        f"design {STEEL} --json --bulk-density 900 --flow-function-intercept 0.5 "
        "--flow-function-slope 0.3"
    )
    for key in ("critical_stress_kpa", "outlet_m"):
        assert json.loads(measured)[key] == pytest.approx(json.loads(straight)[key], rel=1e-12)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "has no rows"),
        ("sigma,f_c\n1,2\n", "has no column sigma_1"),
        ("sigma_1,f_c\n1,2\n2;3,4\n", "row 3, column sigma_1: '2;3' is no stress"),
        ("sigma_1,f_c\n1\n", "row 2, column f_c"),
        ("sigma_1,f_c\n2,1\n1,1\n", "must increase"),
        ("sigma_1,f_c\n1,nan\n", "row 2, column f_c: 'nan' is no stress"),
        ("sigma_1,f_c\n1,9\n2,10\n", "no outlet keeps an arch from forming"),
    ],
)
def test_flow_functions_that_are_refused(run, tmp_path, content, message):
    path = tmp_path / "powder.csv"
    path.write_text(content, encoding="utf-8")
    code, out, err = run(f"design {STEEL} --bulk-density 900 --flow-function {path}")
    assert (code, out) == (2, "")
    assert err.startswith("hopper: error: argument --flow-function: ")
    assert message in err
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("--bulk-density 900", "needs a flow function too"),
        ("--flow-function-intercept 1", "argument --bulk-density: the outlet needs it"),
        ("--flow-function-slope 0.1", "give --flow-function-intercept too"),
        ("--flow-function nosuch.csv --bulk-density 900", "there is no file nosuch.csv"),
        ("--flow-function a.csv --flow-function-intercept 1 --bulk-density 900", "not both"),
        ("--margin 95", "argument --margin: 95 is out of range"),
        ("--bulk-density 0.9 --flow-function-intercept 1", "kg/m^3 from 1 to 30000"),
        ("--disturbances any", "singular at the apex of a cone"),
    ],
)
def test_options_that_are_refused(run, options, message):
    code, out, err = run(f"design {STEEL} {options}")
    assert (code, out) == (2, "")
    assert message in err
    assert len(err.splitlines()) == 1


def test_a_wall_rougher_than_its_material(run):
    code, _, err = run("design --geometry cone --delta 30 --phi 34")
    assert code == 1
    assert "transmits at most phi = 30 deg" in err


@pytest.mark.parametrize(
    ("command", "terms"),
    [
        (f"radial {STEEL} --half-angle 20", {"mass flow", "fold", "Sokolovskii angle", "tangency"}),
        (f"stability {STEEL} --half-angle 20", {"eigenvalue", "asymptotic line", "abscissa"}),
        (f"design {STEEL}", {"mass-flow limit", "flow factor"}),
    ],
)
def test_terms_are_explained(run, command, terms):
    _, plain, _ = run(command)
    _, out, _ = run(f"{command} --explain")
    assert out.startswith(plain.rstrip("\n"))
    explained = out[len(plain) :]
    known = glossary.definitions()
    for term in terms:
        assert f"{term}: {known[term]}\n" in explained
    assert "strip of high frequency" not in explained


def test_definitions_are_one_each_and_plain():
    known = glossary.definitions()
    assert len(set(known.values())) == len(known)
    assert all(not text.endswith(".") and "\n" not in text for text in known.values())
