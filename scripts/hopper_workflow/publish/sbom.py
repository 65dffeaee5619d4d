"""The software bill of materials: every package of the locks, as CycloneDX."""

import json
import re
import sys
import tomllib
from collections import defaultdict
from pathlib import Path

from cyclonedx.model import HashAlgorithm, HashType, Property
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentScope, ComponentType
from cyclonedx.output.json import JsonV1Dot6
from packageurl import PackageURL

import hopper
from hopper_workflow.artifacts import replacing
from hopper_workflow.publish import locks


def write_sbom(path: Path, directory: Path) -> None:
    """Write the packages of the locks in a directory, with hashes; same locks, same bytes.

    The scope of a package is required if runs need it, optional if runs on a cluster do, and
    excluded if only builds and tests do.

    Raises
    ------
    LockError
        If a lock is missing or damaged.
    """
    users = defaultdict(set)
    for use, lock in locks.LOCKS.items():
        for package in locks.read(directory / lock):
            users[package].add(use)
    components = [_component(package, users[package]) for package in users]
    name, wanted = _direct(directory / "pyproject.toml")
    root = Component(name=name, version=hopper.__version__, type=ComponentType.APPLICATION)
    root.bom_ref.value = name
    bom = Bom(components=components)
    bom.metadata.component = root
    bom.register_dependency(root, [part for part in components if part.name in wanted])
    content = json.loads(JsonV1Dot6(bom).output_as_string())
    # What differs from one writing to the next.
    del content["serialNumber"], content["metadata"]["timestamp"]
    path.parent.mkdir(exist_ok=True)
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(content, indent=2, sort_keys=True) + "\n", encoding="utf-8")


def _direct(project: Path) -> tuple[str, set[str]]:
    """Return a project's name and those of what runs need, without what that needs in turn."""
    content = tomllib.loads(project.read_text(encoding="utf-8"))["project"]
    wanted = content["dependencies"] + content["optional-dependencies"]["workflow"]
    names = {re.split(r"[^\w.-]", one)[0].lower().replace("_", "-") for one in wanted}
    return content["name"], names


def _component(package: locks.Package, uses: set[str]) -> Component:
    scopes = {"run": ComponentScope.REQUIRED, "cluster": ComponentScope.OPTIONAL}
    properties = [Property(name="hopper:locks", value=" ".join(sorted(uses)))]
    if package.marker:
        properties.append(Property(name="hopper:marker", value=package.marker))
    purl = PackageURL("pypi", name=package.name, version=package.version)
    return Component(
        name=package.name,
        version=package.version,
        purl=purl,
        bom_ref=str(purl),
        scope=next((scopes[use] for use in scopes if use in uses), ComponentScope.EXCLUDED),
        hashes=[HashType(alg=HashAlgorithm.SHA_256, content=digest) for digest in package.hashes],
        properties=properties,
    )


if __name__ == "__main__":
    target = Path("results/sbom.cdx.json")
    try:
        write_sbom(target, Path.cwd())
    except (locks.LockError, OSError) as error:
        sys.exit(f"{target} not written: {error}")
    print(target)
