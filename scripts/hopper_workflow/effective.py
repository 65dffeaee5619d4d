"""The configuration a run really had, where options made it another than that of config.yaml."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from hopper_workflow import configuration, strict_yaml
from hopper_data.files import replacing

OWN, RECORD = Path("config.yaml"), Path("results/configuration.yaml")
_HEADER = (
    "# What the last run was configured with, which was not config.yaml alone. The same again:\n"
    f"# make CONFIG={RECORD}\n"
)


def of_last_run() -> Path | None:
    """Return the file with the configuration of the last run, None if that was config.yaml's."""
    return RECORD if RECORD.exists() else None


def option(path: Path | None) -> list[str]:
    """Return the option by which Snakemake takes a configuration."""
    return ["--configfile", str(path)] if path else []


def merged(path: Path | None, schema: str | Path) -> dict[str, Any]:
    """Return config.yaml, brought up to date, with what a file of ``--configfile`` changes in it.

    Raises
    ------
    ConfigurationError
        If a file cannot be read.
    """
    from snakemake.utils import update_config  # takes a second, and few need it

    content: dict[str, Any] = {}
    try:
        for one in (OWN, path):
            if one is not None and (one == path or one.exists()):
                update_config(content, strict_yaml.read(one))
    except strict_yaml.StrictYamlError as error:
        raise configuration.ConfigurationError(str(error)) from None
    configuration.bring_up_to_date(content, schema)
    return content


def text(config: Mapping[str, Any]) -> str:
    """Return a configuration as YAML that its strict reader takes."""
    plain = json.loads(json.dumps(config))  # no two lists are one, which YAML would mark
    return yaml.safe_dump(plain, sort_keys=False, allow_unicode=True)


def leave_record(config: Mapping[str, Any], schema: str | Path) -> None:
    """Keep the configuration of a run beside its results, unless it is that of config.yaml."""
    if config == merged(None, schema):
        RECORD.unlink(missing_ok=True)
        return
    with replacing(RECORD) as temporary:
        temporary.write_text(_HEADER + text(config), encoding="utf-8")
