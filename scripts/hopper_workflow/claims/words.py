"""What the paper claims: resources/claims.yaml, checked."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hopper_workflow import strict_yaml
from hopper_workflow.configuration import ConfigurationError, require_schema


@dataclass(frozen=True)
class Claim:
    """An entry of the file; its schema tells what each field means."""

    id: str
    place: str
    claim: str
    paper: str
    unit: str
    test: str
    artifacts: dict[str, str]
    at: dict[str, float]
    thresholds: dict[str, dict[str, Any]]
    parameters: dict[str, Any]
    exactly: float | None

    @property
    def numbers(self) -> dict[str, float]:
        """Numbers the judging function takes."""
        return {**self.at, **{name: item["value"] for name, item in self.thresholds.items()}}

    @property
    def test_in_full(self) -> str:
        """The test with its thresholds."""
        used = [f"{x['value']:g} ({x['reason']})" for x in self.thresholds.values()]
        label = "Threshold" if len(used) == 1 else "Thresholds"
        return f"{self.test} {label}: {'; '.join(used)}." if used else self.test

    @property
    def paths(self) -> list[str]:
        """Artifacts as rules name them."""
        return [f"results/{path}" for path in self.artifacts.values()]


def read_claims(path: str | Path, schema: str | Path) -> list[Claim]:
    """Return the claims in the file's order.

    Raises
    ------
    ConfigurationError
        If the file does not obey the schema, or two claims have the same id.
    """
    claims = [_claim(entry) for entry in _read(path, schema)["claims"]]
    name, count = Counter(claim.id for claim in claims).most_common(1)[0]
    if count > 1:
        raise ConfigurationError(f"{Path(path).name}: {count} claims have the id '{name}'")
    return claims


def read_not_judged(path: str | Path, schema: str | Path) -> list[dict[str, str]]:
    """Return the statements without a verdict: place, statement and reason of each.

    Raises
    ------
    ConfigurationError
        If the file does not obey the schema.
    """
    return list(_read(path, schema)["not_judged"])


def paths_of(claims: Sequence[Claim]) -> list[str]:
    """Return the artifacts that any of the claims needs, sorted."""
    return sorted({path for claim in claims for path in claim.paths})


def half_angles_in(paths: Sequence[str]) -> list[str]:
    """Return the half angles, in degrees, of the maps and borders among the paths, sorted."""
    found = (re.fullmatch(r"results/(map|borders|paper_border)/\w+_([\d.]+)\.nc", p) for p in paths)
    return sorted({match[2] for match in found if match})


def _read(path: str | Path, schema: str | Path) -> dict[str, Any]:
    content = strict_yaml.read_own(path)
    require_schema(content, schema, Path(path).name)
    return content


def _claim(entry: dict[str, Any]) -> Claim:
    return Claim(**{"at": {}, "thresholds": {}, "parameters": {}, "exactly": None, **entry})
