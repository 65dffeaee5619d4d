"""Figures follow from the configuration: entries under free names, any number of half angles."""

import copy
from pathlib import Path

import pytest
import yaml

from hopper_workflow import configuration, entries
from tests.workflow.conftest import ROOT

OWN = Path(__file__).with_name("own_figures.yaml")
SCHEMA = ROOT / "workflow/schemas/config.schema.yaml"
FIGURES = (
    "own_fields",
    "own_angles",
    "fig_4_2_20",
    "fig_4_2_20_physical",
    "own_growth",
    "own_norms",
    "own_plane",
    "fig_4_4_20",
    "fig_4_5",
    "fig_4_5_map",
    "own_breakdown",
    "own_decay",
    "own_amplitudes",
    "own_depth",
)
# Among them rules that follow from a kind, an entry of another, and a number of half angles.
SOME = ("own_angles", "own_growth", "fig_4_4_20", "fig_4_5_map", "own_breakdown")


@pytest.fixture
def config():
    """The configuration with one entry of each kind added."""
    whole = yaml.safe_load((ROOT / "config.yaml").read_text(encoding="utf-8"))
    for section, added in yaml.safe_load(OWN.read_text(encoding="utf-8")).items():
        whole[section] |= added
    return whole


def test_every_entry_is_a_figure(config):
    configuration.check(config, SCHEMA)
    assert set(FIGURES) <= {drawing.figure for drawing in entries.drawings(config)}


@pytest.mark.parametrize(
    ("figure", "number"),
    [
        ("fig_3_1", "3.1"),
        ("fig_4_4_30", "4.4 30"),
        ("fig_jenike", "jenike"),
        ("fig_4_5_map", "4.5 map"),
        ("my_cone", "my cone"),
    ],
)
def test_figures_are_listed_by_their_numbers(figure, number):
    assert entries.number_of(figure) == number


@pytest.mark.workflow
@pytest.mark.parametrize(
    "figures",
    [pytest.param(SOME, id="some"), pytest.param(FIGURES, id="all", marks=pytest.mark.soak)],
)
def test_entries_give_their_figures_without_a_rule_edited(rebuilt, figures):
    path = rebuilt.path / "own.yaml"
    path.write_text(OWN.read_text(encoding="utf-8"), encoding="utf-8")
    wanted = [f"figures/{name}.png" for name in figures]
    done = rebuilt.snakemake("--configfile", path.name, "--", *wanted)
    assert done.returncode == 0, done.stderr
    for name in wanted:
        assert (rebuilt.path / name).stat().st_size > 10_000
        (rebuilt.path / name).unlink()
    asked = rebuilt.snakemake("-n", "--configfile", path.name).stdout
    assert "rule all" in asked
    for name in FIGURES:
        assert f"figures/{name}.pdf" in asked


def refused(config, message):
    with pytest.raises(configuration.ConfigurationError, match=message) as caught:
        configuration.check(config, SCHEMA)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("section", "name", "owner"),
    [
        ("radial", "fig_4_1", "the project"),
        ("friction_curves", "fig_4_5_map", "the project"),
        ("pseudospectrum", "fig_3_1", "radial.fig_3_1"),
        ("transient", "fig_4_2_physical", "spectra.fig_4_2"),
        ("radial", "case_steel_cone", "radial.case_steel_cone"),
    ],
)
def test_a_name_that_is_taken_is_refused(config, section, name, owner):
    config[section][name] = copy.deepcopy(next(iter(config[section].values())))
    refused(config, f"the figure {name} is taken by {owner}: give another name")


@pytest.mark.parametrize("name", ["Own", "own figure", "../own", "4", "own\n"])
def test_a_name_that_is_no_file_name_is_refused(config, name):
    config["radial"][name] = config["radial"]["own_fields"]
    refused(config, "lower-case letter, then up to 40")


def test_curves_that_cannot_be_told_apart_are_refused(config):
    config["radial"]["own_fields"]["mu"] = [0.2, 0.2000000001]
    refused(config, "'radial.own_fields.mu': two values are equal to six digits")
    config["radial"]["own_fields"]["mu"] = [0.01 * index for index in range(9)]
    refused(config, "radial.own_fields.mu': .*cannot be told apart, make two entries")


def test_a_spectrum_that_is_not_there_is_named(config):
    config["transient"]["own_growth"]["spectrum"] = "fig_9"
    refused(config, "'transient.own_growth.spectrum': 'fig_9' is no entry of spectra: there is fig")


def test_bounds_are_of_one_curve(config):
    config["transient"]["own_norms"]["kind"] = "bounds"
    refused(config, "'transient.own_norms.kind': bounds draws one curve")


@pytest.mark.parametrize(
    ("top", "words"),
    [
        ({"name": "bump-s"}, "bump-s needs eps beside its name"),
        ({"name": "scaled", "eps": 0.1}, "scaled needs factor beside its name"),
        ({"name": "bin", "factor": 2}, "bin needs no number beside its name"),
        ({"name": "mine.csv", "eps": 0.1}, "mine.csv needs no number beside its name"),
        ({"name": "flat"}, "top.name.: .flat. does not match"),
        ({"name": "mine.csv"}, "top.: there is no file mine.csv: correct its path"),
    ],
)
def test_a_top_has_the_number_it_needs(config, top, words):
    config["march_breakdown"]["own_breakdown"]["top"] = top
    refused(config, words)


def test_the_top_of_a_cone_is_symmetric(config):
    config["march_breakdown"]["own_breakdown"]["hopper"]["geometry"] = "cone"
    refused(config, "own_breakdown.top.: the top of a cone must be symmetric: use bump-s")


def test_jobs_read_the_files_of_tops(config, tmp_path):
    file = tmp_path / "mine.nc"
    file.touch()
    entry = config["march_depth"]["own_depth"]
    assert entries.files_of_tops(entry) == []
    entry["tops"].append({"name": str(file)})
    configuration.check(config, SCHEMA)
    assert entries.files_of_tops(entry) == [str(file)]


def test_older_words_are_understood(config):
    old = copy.deepcopy(config)
    entry = old["pseudospectrum"].pop("fig_pseudospectrum")
    entry["modes"] = entry.pop("formulations")
    old["pseudospectrum"] |= entry
    configuration.check(old, SCHEMA)
    configuration.bring_up_to_date(old, SCHEMA)
    assert old["pseudospectrum"] == config["pseudospectrum"]
