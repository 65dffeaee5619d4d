"""The RO-Crate of a run: figures, artifacts, configuration and code, each with its checksum.

Follows the Workflow Run Crate profile: one action, the workflow as its instrument, the
configuration and published data as its objects, everything the workflow made as its results.
"""

import hashlib
import json
import mimetypes
import zipfile
from collections import defaultdict
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from io import BytesIO
from pathlib import Path
from typing import Any

from rocrate.model.contextentity import ContextEntity
from rocrate.model.entity import Entity
from rocrate.rocrate import ROCrate

from hopper_workflow import effective, strict_yaml
from hopper_workflow.artifacts import checksum, replacing
from hopper_workflow.publish import locks, run

WORKFLOW, CONFIGURATION, CITATION = Path("Snakefile"), Path("config.yaml"), Path("CITATION.cff")
SCHEMA = Path("workflow/schemas/config.schema.yaml")
# With these the workflow can be run, tested and verified from the crate alone.
CODE = (
    *("workflow", "scripts", "src", "envs", "profiles", "resources", "tests", "benchmarks", "docs"),
    *(".ci", ".github", ".gitignore", ".snakemake-workflow-catalog.yml"),
    *("Makefile", "pyproject.toml", *locks.LOCKS.values()),
    *("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "config/README.md", "LICENSE", str(CITATION)),
)
FORMATS = {".nc": "application/netcdf", ".yaml": "application/yaml", ".py": "text/x-python"}
RUN_CONTEXT = "https://w3id.org/ro/terms/workflow-run/context"
BIOSCHEMAS = "https://bioschemas.org/profiles/ComputationalWorkflow/1.0-RELEASE"
PROFILES = {
    "https://w3id.org/ro/wfrun/process/0.5": "Process Run Crate",
    "https://w3id.org/ro/wfrun/workflow/0.5": "Workflow Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}


def write_crate(path: Path, configuration: Path | None) -> None:
    """Write the finished run as a zipped RO-Crate; its metadata depend on the run alone.

    Its config.yaml is the configuration the run had, wherever that came from.

    Raises
    ------
    RunError
        If there is no finished run; an older crate stays as it is.
    """
    made = run.products(configuration)
    data = sorted({source for sources in made.values() for source in sources} - set(made))
    latest = datetime.fromtimestamp(max(file.stat().st_mtime for file in made), tz=UTC)
    finished = latest.isoformat(timespec="seconds")

    crate = ROCrate(version="1.1")
    crate.metadata.extra_contexts.append(RUN_CONTEXT)
    workflow = crate.add_workflow(
        WORKFLOW, WORKFLOW, main=True, lang="snakemake", properties=_properties(WORKFLOW)
    )
    _describe(crate, workflow, strict_yaml.read_own(CITATION), finished)
    code = [file for file in _files_below(CODE) if file not in data]
    _add_files(crate, [*code, *sorted(Path("logs").rglob("*.log"))])
    crate.get("README.md")["about"] = crate.root_dataset
    files = _add_files(crate, [*data, *made])
    files[CONFIGURATION] = _add_configuration(crate, configuration)
    for file, sources in made.items():
        if sources:
            files[file]["isBasedOn"] = _compact([files[source] for source in sources])
    inputs = {"configuration": [files[CONFIGURATION]], "data": [files[file] for file in data]}
    outputs = defaultdict(list)
    for file in made:
        outputs[file.parts[0]].append(files[file])
    for end, found in (("input", inputs), ("output", dict(sorted(outputs.items())))):
        workflow[end] = [_parameter(crate, name, values) for name, values in found.items()]
    crate.root_dataset["mentions"] = crate.add_action(
        workflow,
        identifier="#run",
        object=[file for values in inputs.values() for file in values],
        result=[files[file] for file in made],
        properties={
            "name": "Run of the workflow",
            "description": f"{len(made)} files made from the configuration and published data",
            "endTime": finished,
        },
    )
    with replacing(path) as temporary:
        crate.write_zip(temporary)
        _settle(temporary, latest)


def _settle(path: Path, moment: datetime) -> None:
    """Let all who unpack a zip read its files, and let none of these be newer than another."""
    with zipfile.ZipFile(path, "a") as archive:
        for member in archive.infolist():
            member.external_attr = 0o100644 << 16
            member.date_time = moment.timetuple()[:6]
        archive.comment = b"RO-Crate"  # or else the list of members is not written anew


def _add_configuration(crate: ROCrate, path: Path | None) -> Entity:
    content = CONFIGURATION.read_bytes()
    if path is not None:
        content = effective.text(effective.merged(path, SCHEMA)).encode()
    properties = {
        "name": CONFIGURATION.name,
        "encodingFormat": FORMATS[CONFIGURATION.suffix],
        "contentSize": str(len(content)),
        "sha256": hashlib.sha256(content).hexdigest(),
    }
    return crate.add_file(BytesIO(content), CONFIGURATION, properties=properties)


def _add_files(crate: ROCrate, files: Iterable[Path]) -> dict[Path, Entity]:
    return {file: crate.add_file(file, file, properties=_properties(file)) for file in files}


def _describe(crate: ROCrate, workflow: Entity, citation: Mapping[str, Any], finished: str) -> None:
    """Say of the crate and its workflow what CITATION.cff says of the software."""
    root = crate.root_dataset
    root["conformsTo"] = [
        _add(crate, url, "CreativeWork", name=name, version=url.rsplit("/", 1)[1])
        for url, name in PROFILES.items()
    ]
    crate.name, crate.description = citation["title"], citation["abstract"]
    crate.keywords, crate.datePublished = citation["keywords"], finished
    license_url = f"https://spdx.org/licenses/{citation['license']}"
    crate.license = _add(crate, license_url, "CreativeWork", name=citation["license"])
    root["author"] = root["publisher"] = _authors(crate, citation)
    root["citation"] = _compact(
        [
            _add(
                crate,
                f"#reference-{number}",
                "ScholarlyArticle",
                name=reference["title"],
                datePublished=str(reference["year"]),
                isPartOf=f"{reference['journal']} {reference['volume']}",
                author=_authors(crate, reference),
            )
            for number, reference in enumerate(citation["references"], start=1)
        ]
    )
    workflow["conformsTo"] = {"@id": BIOSCHEMAS}
    workflow["name"], workflow["version"] = citation["title"], str(citation["version"])
    workflow["license"], workflow["creator"] = crate.license, root["author"]


def _authors(crate: ROCrate, work: Mapping[str, Any]) -> Entity | list[Entity]:
    """Return the authors of a work in CITATION.cff as entities: people, or one body of people."""
    names = [
        (author["name"], "Organization")
        if "name" in author
        else (f"{author['given-names']} {author['family-names']}", "Person")
        for author in work["authors"]
    ]
    return _compact(
        [_add(crate, "#" + name.replace(" ", "-"), kind, name=name) for name, kind in names]
    )


def _parameter(crate: ROCrate, name: str, values: list[Entity]) -> Entity:
    """Add an input or output of the workflow, of which ``values`` are what this run had."""
    parameter = crate.add_formal_parameter(
        name, "File", identifier=f"#{name}", properties={"multipleValues": len(values) > 1}
    )
    for value in values:
        value["exampleOfWork"] = parameter
    return parameter


def _properties(file: Path) -> dict[str, Any]:
    """Return what is known of a file; of an artifact also what its provenance says."""
    guess = FORMATS.get(file.suffix) or mimetypes.guess_type(file)[0] or "text/plain"
    properties: dict[str, Any] = {
        "name": file.name,
        "encodingFormat": guess,
        "contentSize": str(file.stat().st_size),
        "sha256": checksum(file),
    }
    provenance = file.with_suffix(".provenance.json")
    if file.suffix == ".nc" and provenance.exists():
        record = json.loads(provenance.read_text(encoding="utf-8"))
        properties |= {
            "name": record["title"],
            "description": f"Equations: {record['equations']}",
            "dateCreated": record["created"],
            "subjectOf": {"@id": provenance.as_posix()},
        }
    return properties


def _files_below(names: Iterable[str]) -> list[Path]:
    """Return the files of the names given, those of folders without what Python leaves in them."""
    found = {
        file
        for name in names
        for file in [Path(name), *Path(name).rglob("*")]
        if file.is_file()
        and not any(part.endswith(("__pycache__", ".egg-info")) for part in file.parts)
    }
    return sorted(found)


def _add(crate: ROCrate, identifier: str, kind: str, **properties: Any) -> Entity:
    return crate.add(ContextEntity(crate, identifier, properties={"@type": kind, **properties}))


def _compact(entities: list[Entity]) -> Entity | list[Entity]:
    """Return a single entity as itself, as RO-Crate recommends."""
    return entities[0] if len(entities) == 1 else entities


if __name__ == "__main__":
    run.publish(write_crate, "results/hopper-crate.zip")
