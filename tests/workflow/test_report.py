"""The report and the crate are written from a finished run only."""

import pytest

from hopper_workflow.publish import run

pytestmark = pytest.mark.workflow


@pytest.mark.parametrize(
    ("what", "path"), [("report", "results/report.html"), ("crate", "results/hopper-crate.zip")]
)
def test_there_is_none_before_a_run(fresh, what, path):
    done = fresh.publish(what)
    assert done.returncode == 1
    assert done.stdout == ""
    assert done.stderr.startswith(f"{path} not written: ")
    assert done.stderr.endswith(
        "missing or out of date, first figures/fig_1_1.png: build them with: make\n"
    )
    assert not (fresh.path / "results").exists()


def test_an_outdated_run_leaves_an_older_report_alone(rebuilt):
    report = rebuilt.path / "results/report.html"
    report.write_text("an older report")
    rebuilt.set("radial.fig_3_1.mu", [0, 0.25])
    done = rebuilt.publish("report")
    assert done.returncode == 1
    assert "results are missing or out of date, first figures/fig_3_1.png" in done.stderr
    assert "build them with: make" in done.stderr
    assert report.read_text() == "an older report"


def test_a_bad_configuration_is_named(rebuilt):
    rebuilt.set("radial.fig_3_1.points", "many")
    done = rebuilt.publish("report")
    assert done.returncode == 1
    assert "config key 'radial.fig_3_1.points': 'many' is not of type 'integer'" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_file_that_cannot_be_written_is_named_in_one_line(tmp_path, monkeypatch):
    def write(path, configuration):
        path.write_text("whole")

    path = tmp_path / "no such folder" / "report.html"
    monkeypatch.setattr("sys.argv", ["report"])
    with pytest.raises(SystemExit) as ended:
        run.publish(write, str(path))
    assert str(ended.value).startswith(f"{path} not written: ")
    assert "\n" not in str(ended.value)
