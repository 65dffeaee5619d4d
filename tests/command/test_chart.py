"""`hopper chart`: a chart of one's own."""

import pytest


def test_a_chart_is_drawn(run, tmp_path, monkeypatch):
    monkeypatch.setattr("hopper_cli.charts._POINTS", 3)
    out = tmp_path / "chart.png"
    code, said, err = run(f"chart --geometry cone --delta 42 --out {out}")
    assert (code, err) == (0, "")
    assert said == f"The design chart of a cone, delta 42 deg: {out}.\n"
    assert out.read_bytes().startswith(b"\x89PNG")
    assert run(f"chart --geometry cone --delta 42 --out {out}")[0] == 2  # it exists


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("--delta 10 --out a.png", "argument --delta: 10 is out of range: give degrees from 20"),
        ("--delta 40 --out a.txt", "argument --out: a.txt has no known suffix: use .png or .pdf"),
        ("--out a.png", "the following arguments are required: --delta"),
    ],
)
def test_options_that_are_refused(run, tmp_path, monkeypatch, options, message):
    monkeypatch.chdir(tmp_path)
    code, _, err = run(f"chart --geometry cone {options}")
    assert code == 2
    assert message in err
    assert list(tmp_path.iterdir()) == []
