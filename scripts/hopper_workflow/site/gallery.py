"""The gallery: a page for each figure, with all that it is made from."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import jinja2
import yaml

from hopper_workflow import entries
from hopper_workflow.site.source import Source, heading

# Sections of the configuration that figures of no section of their own follow from.
_SECTIONS = {
    "fig_design_cone": ("design_charts",),
    "fig_design_wedge": ("design_charts",),
    "fig_jenike": ("fig_jenike",),
    "fig_4_1": ("smooth_wall",),
    "fig_resolvent": ("sensitivity",),
    "fig_4_5": ("stability_map", "borders", "paper_border"),
    "fig_4_5_map": ("stability_map", "fig_4_5_map"),
    "fig_vm_types": ("von_mises",),
    "fig_vm_decay": ("von_mises",),
    "fig_models_stability": ("von_mises", "borders"),
}
_DATA = (".nc", ".csv")


@dataclass(frozen=True)
class Made:
    """How the workflow makes a figure: its rule, and the files of data it reads."""

    rule: str
    data: list[str]


def made(summary: Mapping[str, Mapping[str, str]], figure: str) -> Made:
    """Return how a figure is made, from Snakemake's summary by output file."""
    row = summary[f"figures/{figure}.png"]
    data = [path for path in row["input-file(s)"].split(",") if path.endswith(_DATA)]
    return Made(row["rule"], sorted(data))


def write(
    source: Source, root: Path, config: Mapping[str, Any], summary: Mapping[str, Mapping[str, str]]
) -> list[str]:
    """Write the gallery; return the figures that are not drawn yet, whose pages have text alone."""
    titles, missing = {}, []
    for drawing in entries.drawings(config):
        figure, how = drawing.figure, made(summary, drawing.figure)
        files = [f"figures/{figure}.png", *how.data]
        for path in files:
            if (root / path).exists():
                source.copy(path, root / path)
        drawn = all((root / path).exists() for path in files)
        if not drawn:
            missing.append(figure)
        words = caption(root, config, drawing, how)
        titles[figure] = title_of(figure, words)
        lines = _picture(figure, titles[figure], drawn=drawn)
        lines += [words + "\n", *_made_from(root, config, drawing, how)]
        source.write(f"gallery/{figure}.rst", "\n".join(lines) + "\n")
    source.write("gallery/index.rst", _index(titles, missing))
    return missing


def title_of(figure: str, words: str) -> str:
    """Return the title of a figure's page: its number, or else what its caption begins with."""
    number = entries.number_of(figure)
    if number[0].isdigit():
        return f"Figure {number}"
    bold = re.match(r"[*][*](.+?)[.]?[*][*]", words, flags=re.DOTALL)
    return " ".join(bold[1].split()) if bold else number.capitalize()


def _index(titles: Mapping[str, str], missing: list[str]) -> str:
    """Return the page of all figures: those of the paper first."""
    names = sorted(titles, key=lambda name: (not titles[name].startswith("Figure"), titles[name]))
    lines = [heading("Gallery"), "Every figure, with its caption and all that it is made from.\n"]
    if len(missing) < len(names):
        lines.append(".. container:: gallery\n")
    for name in names:
        if name not in missing:
            lines.append(
                f"   .. figure:: /figures/{name}.png\n      :target: {name}.html\n"
                f"      :alt: {titles[name]}\n\n      :doc:`{name}`\n"
            )
    hidden = "" if missing else "   :hidden:\n"
    lines += [f".. toctree::\n   :maxdepth: 1\n{hidden}", *(f"   {name}" for name in names)]
    return "\n".join(lines) + "\n"


def _picture(figure: str, title: str, *, drawn: bool) -> list[str]:
    """Return the beginning of a figure's page."""
    image = f".. image:: /figures/{figure}.png\n   :alt: {title}\n"
    missing = f"*Not drawn yet*: ``make figures/{figure}.png`` draws it.\n"
    return [f".. _{figure}:\n", heading(title), image if drawn else missing]


def _made_from(
    root: Path, config: Mapping[str, Any], drawing: entries.Drawing, how: Made
) -> list[str]:
    """Return what a figure is made from: rule, script, data, configuration."""
    figure = drawing.figure
    lines = [
        heading("What it is made from", "-"),
        f":Target: ``make figures/{figure}.png``",
        f":Rule: ``{how.rule}``, in ``workflow/rules``",
        f":Script: ``scripts/{how.rule}.py``",
    ]
    if how.data:
        lines.append(":Data:")
    for path in how.data:
        there = (root / path).exists()
        lines.append(f"   - :download:`{path} </{path}>`" if there else f"   - ``{path}``")
    lines.append(f":For print: ``figures/{figure}.pdf``")
    lines.append(":Configuration: :doc:`all keys </configuration>`; here:\n")
    lines.append("   .. code-block:: yaml\n")
    text = yaml.safe_dump(entry_of(config, drawing), sort_keys=False, default_flow_style=None)
    return [*lines, *(f"      {line}" for line in text.splitlines())]


def entry_of(config: Mapping[str, Any], drawing: entries.Drawing) -> dict[str, Any]:
    """Return the part of the configuration that a figure is about."""
    if not drawing.key:
        sections = _SECTIONS.get(drawing.figure, (drawing.figure.removeprefix("fig_"),))
        known = [name for name in (*sections, drawing.figure) if name in config]
        return {name: config[name] for name in known}
    if drawing.kind == "case":
        return {"cases": [case for case in config["cases"] if case["name"] == drawing.entry]}
    section = drawing.key.partition(".")[0]
    return {section: {drawing.entry: config[section][drawing.entry]}}


def caption(root: Path, config: Mapping[str, Any], drawing: entries.Drawing, how: Made) -> str:
    """Return the caption of the report, with the numbers of the configuration."""
    own: Any = next(iter(entry_of(config, drawing).values()), {})
    if drawing.kind == "case":
        own = {"case": own[0]}
    elif drawing.key:
        own = own[drawing.entry]
    name = "case" if drawing.kind == "case" else how.rule.removeprefix("plot_")
    text = (root / f"workflow/report/{name}.rst").read_text(encoding="utf-8")
    geometry = drawing.figure.rpartition("_")[2]
    job = SimpleNamespace(
        config=config,
        wildcards=SimpleNamespace(figure=drawing.entry, case=drawing.entry, geometry=geometry),
        params=dict(own, stagnant_from_deg=config["fig_3_2"]["stagnant_from_deg"]),
    )
    environment = jinja2.Environment(undefined=jinja2.StrictUndefined)
    return environment.from_string(text).render(snakemake=job).strip()
