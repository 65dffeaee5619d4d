"""`hopper table`: every row answered or with its reason, nothing lost."""

import csv
import json

import numpy as np
import pytest
import xarray as xr

from hopper_cli import columns, sheets

TITLES = "name,geometry,delta,half-angle,phi,mu"
ROWS = (
    "=A1,cone,40,20,16,",
    "b,cone,40,36,16,",
    "c,wedge,45,20,20,",
    'd,wedge,"38,5",20,20,',
    "e,cone,25,30,,0.4",
    "f,pyramid,25,30,,0.4",
    "g,cone,30,10,35,",
    "h,cone,30,10,5,0.1",
)


@pytest.fixture
def hoppers(tmp_path):
    path = tmp_path / "hoppers.csv"
    path.write_text("\n".join([TITLES, *ROWS]) + "\n", encoding="utf-8")
    return path


def read(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_every_row_has_its_answer_or_its_reason(run, hoppers, tmp_path):
    out = tmp_path / "answers.csv"
    code, said, _ = run(f"table {hoppers} --out {out} --cores 1")
    assert code == 0
    assert said == (f"8 hoppers answered in {out}, 5 without a verdict: see the column reason.\n")
    rows = read(out)
    assert [row["name"] for row in rows] == ["'=A1", *"bcdefgh"]
    assert [row["verdict"] for row in rows] == ["stable", "", "stable", "", "unstable", "", "", ""]
    for row, words in (
        (1, "the largest friction that has one"),
        (3, "column delta: '38,5' is no number"),
        (5, "geometry = 'pyramid' is unknown"),
        (6, "transmits at most phi = 30 deg"),
        (7, "give one of the columns mu and phi"),
    ):
        assert words in rows[row]["reason"]
    assert all(bool(row["verdict"]) != bool(row["reason"]) for row in rows)
    assert rows[0]["sentence"] == "Mass flow: yes, with 12.4 deg of half angle to spare."


def test_a_row_says_what_the_other_commands_say(run, hoppers, tmp_path):
    out = tmp_path / "answers.json"
    run(f"table {hoppers} --out {out} --cores 1")
    rows = json.loads(out.read_text(encoding="utf-8"))
    for row in (rows[0], rows[2]):
        compare_with_commands(run, row)


@pytest.mark.parametrize("number", [6, pytest.param(60, marks=pytest.mark.soak)])
def test_rows_at_random_say_what_the_other_commands_say(run, tmp_path, number):
    print("seed 2110")
    rng = np.random.default_rng(2110)
    path, out = tmp_path / "list.csv", tmp_path / "answers.json"
    ranges = ((30, 60), (5, 35), (5, 25))
    rows = [
        ",".join([rng.choice(["cone", "wedge"]), *(f"{rng.uniform(*ends):.4f}" for ends in ranges)])
        for _ in range(number)
    ]
    path.write_text("\n".join(["geometry,delta,half-angle,phi", *rows]) + "\n", encoding="utf-8")
    assert run(f"table {path} --out {out} --cores 1")[0] == 0
    for row in json.loads(out.read_text(encoding="utf-8")):
        compare_with_commands(run, row)


def compare_with_commands(run, row):
    case = (
        f"--geometry {row['geometry']} --delta {row['delta']} --half-angle "
        f"{row['half-angle']} --phi {row['phi']} --json"
    )
    radial, stability = (json.loads(run(f"{it} {case}")[1]) for it in ("radial", "stability"))
    if "error" in stability:
        assert row["verdict"] is None
        assert row["reason"] == stability["error"]["message"]
        return
    assert row["sentence"] == radial["sentence"] == stability["sentence"]
    assert row["verdict"] == stability["verdict"]
    assert row["governed_by"] == stability["governed_by"]
    difference = abs(row["abscissa"] - stability["abscissa"])
    assert difference <= row["abscissa_error"] + stability["error_estimate"]
    assert abs(row["flow_factor"] - radial["flow_factor"]) <= row["flow_factor_error"] * 2


def test_netcdf_has_a_variable_for_each_column(run, hoppers, tmp_path):
    out = tmp_path / "answers.nc"
    run(f"table {hoppers} --out {out} --cores 1")
    with xr.open_dataset(out) as data:
        assert data.sizes == {"row": len(ROWS)}
        assert list(data) == [*TITLES.split(","), *columns.SHORT]
        assert data.abscissa.dtype == float


def test_more_columns(run, hoppers, tmp_path):
    out = tmp_path / "answers.json"
    asked = "design,psi_wall_deg,transient_growth,mu_limit"
    assert run(f"table {hoppers} --out {out} --cores 1 --columns {asked}")[0] == 0
    rows = json.loads(out.read_text(encoding="utf-8"))
    expected = [*columns.SHORT[:-1], *columns.Columns(asked.split(",")).titles]
    assert list(rows[0]) == [*TITLES.split(","), *dict.fromkeys(expected)]
    row = rows[0]
    case = "--geometry cone --delta 40 --phi 16 --json"
    designed = json.loads(run(f"design {case}")[1])
    solved = json.loads(run(f"radial {case} --half-angle 20")[1])
    judged = json.loads(run(f"stability {case} --half-angle 20")[1])
    for answer, name in (
        (designed, "half_angle_classical_deg"),
        (designed, "half_angle_recommended_deg"),
        (designed, "velocity_ratio"),
        (solved, "mu_limit"),
        (solved, "psi_wall_deg"),
        (judged, "transient_growth"),
    ):
        assert row[name] == answer[name], name
        assert row[f"{name}_error"] == answer["errors"][name]
    assert row["half_angle_governed_by"] == designed["governed_by"]
    assert "velocity: radial flow reaches the wall wherever it exists" in row["reason"]
    assert rows[1]["half_angle_classical_deg"] == row["half_angle_classical_deg"]
    assert rows[1]["transient_growth"] is None
    assert rows[5]["half_angle_classical_deg"] is None


def test_workbooks_hold_the_same_cells(run, hoppers, tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    for name in ("a.csv", "a.xlsx"):
        assert run(f"table {hoppers} --out {tmp_path / name} --cores 1")[0] == 0
    titles, *rows = openpyxl.load_workbook(tmp_path / "a.xlsx")["hoppers"].iter_rows()
    written = [
        {title.value: cell.value for title, cell in zip(titles, row, strict=True)} for row in rows
    ]
    for cells, texts in zip(written, read(tmp_path / "a.csv"), strict=True):
        for name, cell in cells.items():
            if isinstance(cell, int | float):
                assert cell == pytest.approx(float(texts[name]), rel=1e-15)
            else:
                assert (cell or "") == texts[name]
    assert {cell.data_type for row in rows for cell in row} <= {"n", "s", "inlineStr"}
    assert written[0]["name"] == "'=A1"
    assert written[0]["delta"] == 40


def test_a_run_that_was_stopped_goes_on(run, hoppers, tmp_path, monkeypatch):
    monkeypatch.setattr(sheets, "_TASK", 1)
    done: list[str] = []
    answer_of, patience = sheets.row_answer, 3

    def counted(listed, row, columns):
        if len(done) == patience:
            raise KeyboardInterrupt
        done.append(listed.rows[row]["name"])
        return answer_of(listed, row, columns)

    monkeypatch.setattr(sheets, "row_answer", counted)
    out = tmp_path / "answers.csv"
    code, _, err = run(f"table {hoppers} --out {out} --cores 1")
    assert code == 130
    assert "stopped after 3 of 8 rows: the same command goes on from there" in err
    assert not out.exists()
    patience = 99
    assert run(f"table {hoppers} --out {out} --cores 1")[0] == 0
    assert sorted(done) == sorted(row.split(",")[0] for row in ROWS)
    assert len(read(out)) == 8
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []


def test_another_list_does_not_go_on(run, hoppers, tmp_path):
    out = tmp_path / "answers.csv"
    out.with_name(".answers.csv.journal").write_text("another\n[0, {}]\n", encoding="utf-8")
    run(f"table {hoppers} --out {out} --cores 1")
    assert read(out)[0]["verdict"] == "stable"


def test_a_list_with_the_same_titles_does_not_go_on_either(run, hoppers, tmp_path, monkeypatch):
    """Other hoppers under the same names of columns are another list."""
    monkeypatch.setattr(sheets, "row_answer", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
    out = tmp_path / "answers.csv"
    run(f"table {hoppers} --out {out} --cores 1")
    journal = out.with_name(".answers.csv.journal")
    mark = journal.read_text(encoding="utf-8")
    hoppers.write_text("\n".join([TITLES, *ROWS[1:]]) + "\n", encoding="utf-8")
    run(f"table {hoppers} --out {out} --cores 1")
    assert journal.read_text(encoding="utf-8") != mark


def test_several_processes_give_the_same_bytes(run, hoppers, tmp_path, monkeypatch):
    monkeypatch.setattr(sheets, "_TASK", 4)
    for cores in (1, 2):
        run(f"table {hoppers} --out {tmp_path / f'{cores}.csv'} --cores {cores}")
    assert (tmp_path / "1.csv").read_bytes() == (tmp_path / "2.csv").read_bytes()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "has no hoppers"),
        (f"{TITLES}\n", "has no hoppers"),
        ("geometry,delta,phi\ncone,40,16\n", "has no column half-angle"),
        ("geometry,delta,half-angle\ncone,40,16\n", "has no column mu or phi"),
        ("geometry,delta,half-angle,mu,mu\ncone,40,16,0,0\n", "has the column 'mu' twice"),
        ("geometry,delta,half-angle,mu\ncone,40,16\n", "row 2 has 3 cells, the titles are 4"),
        (
            "geometry,delta,half-angle,mu,verdict\ncone,40,16,0,yes\n",
            "verdict is one of the answer's",
        ),
    ],
)
def test_lists_that_are_refused(run, tmp_path, content, message):
    path = tmp_path / "list.csv"
    path.write_text(content, encoding="utf-8")
    code, out, err = run(f"table {path} --out {tmp_path / 'answers.csv'}")
    assert (code, out) == (2, "")
    assert err.startswith("hopper: error: argument LIST: ")
    assert message in err
    assert len(err.splitlines()) == 1
    assert not (tmp_path / "answers.csv").exists()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("none.csv --out a.csv", "cannot be read"),
        ("none.csv --out a.xls", "has no known suffix: use .csv or .xlsx or .json or .nc"),
        ("none.csv --out nosuch/a.csv", "the folder nosuch does not exist"),
        ("none.csv --out a.csv --cores 0", "a whole number from 1 to 1024"),
    ],
)
def test_options_that_are_refused(run, tmp_path, monkeypatch, options, message):
    monkeypatch.chdir(tmp_path)
    code, _, err = run(f"table {options}")
    assert code == 2
    assert message in err
    assert list(tmp_path.iterdir()) == []


def test_unknown_columns_are_named(run, hoppers, tmp_path):
    code, _, err = run(f"table {hoppers} --out {tmp_path / 'a.csv'} --columns design,speed")
    assert code == 2
    assert "--columns: 'speed' is unknown: use radial, limits, transients, design, or" in err
    assert not (tmp_path / "a.csv").exists()
