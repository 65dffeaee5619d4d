"""Which figures follow from the configuration: its entries under any free name, and the fixed ones.

An entry NAME of a section makes figures/NAME; where more than one drawing fits, its ``kind`` tells
which. An entry of ``spectra`` has two drawings.
"""

import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

# Figures that are no entry of a section.
_FIXED = (
    "fig_1_1",
    "fig_jenike",
    "fig_design_cone",
    "fig_design_wedge",
    "fig_4_1",
    "fig_resolvent",
    "fig_4_5",
    "fig_4_5_map",
    "fig_domain_angle",
    "fig_vm_types",
    "fig_vm_spectra",
    "fig_vm_decay",
    "fig_models_stability",
)
MARCHES = ("march_breakdown", "march_decay", "march_amplitude", "march_depth")
SECTIONS = ("radial", "spectra", "transient", "pseudospectrum", "friction_curves", *MARCHES)


class Drawing(NamedTuple):
    """A figure, the key of the configuration it follows from, its entry there, and its kind."""

    figure: str
    key: str
    entry: str
    kind: str


def drawings(config: Mapping[str, Any]) -> Iterator[Drawing]:
    """Yield every figure."""
    for figure in _FIXED:
        yield Drawing(figure, "", figure, figure)
    for section in SECTIONS:
        for name, entry in config[section].items():
            kind = kind_of(section, name, entry)
            yield Drawing(name, f"{section}.{name}", name, kind)
            if section == "spectra":
                yield Drawing(f"{name}_physical", f"{section}.{name}", name, "physical")
    for index, case in enumerate(config["cases"]):
        name = case["name"]
        yield Drawing(f"case_{name}", f"cases[{index}].name", name, "case")


def kind_of(section: str, name: str, entry: Mapping[str, Any]) -> str:
    """Return how an entry is drawn: its ``kind``, or what suits it."""
    if "kind" in entry:
        return str(entry["kind"])
    if section == "radial":
        return "velocity_and_psi" if name == "fig_3_2" else "stress_and_velocity"
    if section == "transient":
        return "norms" if _curves(entry) > 1 else "bounds"
    return section


def number_of(figure: str) -> str:
    """Return a figure's number in the paper, with what makes it another one; else its name."""
    match = re.fullmatch(r"fig_(?:(\d)_(\d))?_?(\w*)", figure)
    if match is None:
        return figure.replace("_", " ")
    number = f"{match[1]}.{match[2]} " if match[1] else ""
    return f"{number}{match[3].replace('_', ' ')}".strip()


def of_kind(config: Mapping[str, Any], kind: str) -> list[str]:
    """Return the names of the entries that are drawn in one way."""
    return [drawing.entry for drawing in drawings(config) if drawing.kind == kind]


def problems(config: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield key and problem of names that are taken, unknown, or cannot be told apart."""
    taken: dict[str, str] = {}
    for drawing in drawings(config):
        if drawing.figure in taken:
            by = taken[drawing.figure] or "the project"
            yield drawing.key, f"the figure {drawing.figure} is taken by {by}: give another name"
        taken.setdefault(drawing.figure, drawing.key)
    for section in ("transient", "pseudospectrum"):
        for name, entry in config[section].items():
            if (spectrum := entry["spectrum"]) not in config["spectra"]:
                known = ", ".join(config["spectra"])
                problem = f"'{spectrum}' is no entry of spectra: there is {known}"
                yield f"{section}.{name}.spectrum", problem
    for name, entry in config["transient"].items():
        if kind_of("transient", name, entry) == "bounds" and _curves(entry) > 1:
            problem = "bounds draws one curve: give one norm and one psi_scale, or kind: norms"
            yield f"transient.{name}.kind", problem
    for section, values in (("radial", "mu"), ("friction_curves", "deltas_deg")):
        for name, entry in config[section].items():
            labels = [f"{value:g}" for value in entry[values]]
            if len(set(labels)) < len(labels):
                problem = "two values are equal to six digits: their curves cannot be told apart"
                yield f"{section}.{name}.{values}", problem


def files_of_tops(entry: Mapping[str, Any]) -> list[str]:
    """Return the files that hold tops of an entry of ``march_breakdown`` or ``march_depth``."""
    tops = entry["tops"] if "tops" in entry else [entry["top"]]
    return [top["name"] for top in tops if is_file_of_top(top["name"])]


def is_file_of_top(name: str) -> bool:
    """Return whether the name of a top is that of a file."""
    return name.endswith((".csv", ".nc"))


def _curves(transient: Mapping[str, Any]) -> int:
    """Return the number of curves of an entry of ``transient``, for each geometry."""
    return len(transient["kept_in"]) * len(transient["norms"]) * len(transient["psi_scales"])
