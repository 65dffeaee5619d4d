"""The RO-Crate of a run, read back with the library and checked against the files in it."""

import hashlib
import json
import os
import time
import zipfile
from pathlib import Path

import pytest
from rocrate.rocrate import ROCrate

from hopper import __version__
from tests.workflow.conftest import Workflow, copy, with_make

pytestmark = pytest.mark.workflow


@pytest.fixture(scope="module")
def run(built: Workflow, tmp_path_factory: pytest.TempPathFactory) -> Workflow:
    return copy(tmp_path_factory.mktemp("crate") / "run", results=built.path)


@pytest.fixture(scope="module")
def archive(run: Workflow) -> Path:
    done = run.publish("crate")
    assert done.returncode == 0, done.stderr
    assert done.stdout == "results/hopper-crate.zip\n"
    return run.path / "results/hopper-crate.zip"


@pytest.fixture(scope="module")
def crate(archive: Path) -> ROCrate:
    return ROCrate(archive)


def files(crate: ROCrate):
    return [entity for entity in crate.data_entities if "File" in entity.type]


def test_every_file_is_there_with_its_checksum(crate, archive):
    with zipfile.ZipFile(archive) as content:
        names = set(content.namelist()) - {"ro-crate-metadata.json"}
        assert {entity.id for entity in files(crate)} == names
        for entity in files(crate):
            data = content.read(entity.id)
            assert entity["sha256"] == hashlib.sha256(data).hexdigest(), entity.id
            assert entity["contentSize"] == str(len(data))
            assert entity["encodingFormat"]
        assert {member.external_attr >> 16 for member in content.infolist()} == {0o100644}


def test_the_run_has_its_workflow_inputs_and_results(crate, run):
    action = crate.get("#run")
    assert crate.root_dataset["mentions"] == action
    assert action["instrument"] == crate.mainEntity
    assert "ComputationalWorkflow" in crate.mainEntity.type
    assert crate.mainEntity.id == "Snakefile"
    assert crate.mainEntity["programmingLanguage"]["name"] == "Snakemake"
    assert crate.mainEntity["version"] == __version__
    objects = {entity.id for entity in action["object"]}
    assert objects == {"config.yaml", "resources/jenike_chart_delta40.csv"}
    results = {entity.id for entity in action["result"]}
    for pattern in ("figures/*.png", "figures/*.pdf", "results/**/*.nc", "results/**/*.json"):
        made = {str(path.relative_to(run.path)) for path in run.path.glob(pattern)}
        assert made
        assert made <= results
    for entity in action["object"] + action["result"]:
        assert "FormalParameter" in entity["exampleOfWork"].type


def test_a_figure_leads_to_its_artifacts_their_equations_and_provenance(crate):
    sources = {entity.id for entity in crate.get("figures/fig_4_3.png")["isBasedOn"]}
    assert sources == {f"results/transient/fig_4_3/{name}.nc" for name in ("wedge", "cone")}
    artifact = crate.get("results/transient/fig_4_3/cone.nc")
    assert "(4.11)" in artifact["description"]
    assert artifact["isBasedOn"].id == "results/spectrum/fig_4_2/cone.nc"
    assert artifact["subjectOf"].id == "results/transient/fig_4_3/cone.provenance.json"
    chart = crate.get("results/flow_factor/jenike.nc")["isBasedOn"]
    assert chart.id == "resources/jenike_chart_delta40.csv"


def test_it_says_who_and_what_to_cite(crate):
    assert crate.license.id == "https://spdx.org/licenses/MIT"
    assert crate.root_dataset["author"]["name"] == "The hopper maintainers"
    paper = crate.root_dataset["citation"]
    assert paper["name"] == "Similarity solutions for granular flows in hoppers"
    assert paper["author"][0]["name"] == "Pierre-Alain Gremaud"
    profiles = {entity.id for entity in crate.root_dataset["conformsTo"]}
    assert "https://w3id.org/ro/wfrun/workflow/0.5" in profiles


def test_the_code_in_it_is_what_runs(crate, run):
    code = {entity.id for entity in files(crate)}
    for pattern in ("scripts/**/*.py", "src/**/*.py", "workflow/rules/*.smk"):
        assert {str(path.relative_to(run.path)) for path in run.path.glob(pattern)} <= code
    assert not {name for name in code if "__pycache__" in name}
    assert {"requirements.lock", "Makefile", "LICENSE", "CITATION.cff"} <= code


def test_a_second_crate_of_the_same_run_says_the_same(crate, run, archive):
    def metadata():
        with zipfile.ZipFile(archive) as content:
            return json.loads(content.read("ro-crate-metadata.json"))

    first = metadata()
    assert run.publish("crate").returncode == 0
    assert metadata() == first


@pytest.mark.soak
def test_who_unpacks_it_has_the_run_as_it_was_configured(rebuilt, tmp_path):
    (rebuilt.path / "mine.yaml").write_text("fig_1_1: {half_angle_deg: 25}\n")
    done = with_make(rebuilt, "figures", "CONFIG=mine.yaml")
    assert done.returncode == 0, done.stderr
    done = with_make(rebuilt, "crate", "verify")
    assert done.returncode == 0, done.stderr
    unpacked = Workflow(tmp_path / "unpacked")
    with zipfile.ZipFile(rebuilt.path / "results/hopper-crate.zip") as content:
        content.extractall(unpacked.path)
        for member in content.infolist():  # Python forgets the times, unzip and others do not
            moment = time.mktime((*member.date_time, 0, 0, -1))
            os.utime(unpacked.path / member.filename, (moment, moment))
    assert "half_angle_deg: 25" in (unpacked.path / "config.yaml").read_text(encoding="utf-8")
    assert unpacked.reruns() == set()
    assert unpacked.publish("verify").returncode == 0
    unpacked.build("--force", "figures/fig_1_1.png")
    assert unpacked.products() == rebuilt.products()
    # Without the file the run would be another one.
    assert rebuilt.reruns() == {"plot_fig_1_1"}
