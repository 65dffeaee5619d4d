"""The claims ledger for reading, as a page of its own and as Markdown."""

import csv
import re
from html import unescape
from math import floor, log10
from pathlib import Path

import jinja2

from hopper_workflow import artifacts, jobs
from hopper_workflow.claims.finding import FAILS, HOLDS, LIMITED, UNDECIDED, VERDICTS, upper_bound
from hopper_workflow.claims.words import read_not_judged

# Colours of a contrast of at least 7 : 1; the mark and the words say the same without them.
STYLES = {
    HOLDS: {"css": "holds", "mark": "✓", "background": "#d7f0df", "color": "#0b4a24"},
    LIMITED: {"css": "limits", "mark": "◐", "background": "#fdeec8", "color": "#5a3d00"},
    FAILS: {"css": "fails", "mark": "✗", "background": "#fbdcd6", "color": "#7a1204"},
    UNDECIDED: {"css": "undecided", "mark": "?", "background": "#e6e6ea", "color": "#33333d"},
}
# Below it a value is nothing but the rounding of a few operations.
_ROUNDING = 1e-13
_NAMES = "sigma|psi|delta|theta|phi|mu|lambda|kappa|alpha|omega|chi|rho|epsilon|pi"
# Whole words, perhaps with an index, or one after the other as in T_phiphi.
_LETTERS = rf"(?:(?<![A-Za-z])|(?<=phi|eta))(?:{_NAMES})(?=(?:phi|theta)?(?![A-Za-z]))"
_FIGURES = (
    (r"results/radial/(\w+)\.nc", r"\1"),
    (r"results/(?:spectrum|transient|friction)/(\w+)/\w+\.nc", r"\1"),
    (r"results/stability/(\w+)/\w+\.nc", r"\1_physical"),
    (r"results/(?:borders|paper_border)/\w+\.nc", "fig_4_5"),
    (r"results/map/\w+\.nc", "fig_4_5_map"),
    (r"results/sensitivity/\w+\.nc", "fig_resolvent"),
    (r"results/flow_factor/jenike\.nc", "fig_jenike"),
    (r"results/design/(\w+)\.nc", r"fig_design_\1"),
    (r"results/smooth_wall\.nc", "fig_4_1"),
    (r"results/domain_angle\.nc", "fig_domain_angle"),
    (r"results/march_\w+/(\w+)\.nc", r"\1"),
)
_NOTATION = (
    (r"sqrt\((\d+)\)", r"√\1"),
    (r" deg\b", "°"),
    (r"\^2", "²"),
    (r"\^-2", "⁻²"),
    ("<=", "≤"),
    (r" x_1\b", " x₁"),
)


def render_claims(
    table: str,
    claims: str,
    schema: str,
    html_template: str,
    markdown_template: str,
    html: str,
    markdown: str,
) -> None:
    """Render the ledger at ``table``; ``claims`` adds what has no verdict."""
    with Path(table).open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    content = {
        "rows": rows,
        "groups": {name: [row for row in rows if row["verdict"] == name] for name in VERDICTS},
        "styles": STYLES,
        "not_judged": read_not_judged(claims, schema),
    }
    for template, target, escape in (
        (html_template, html, True),
        (markdown_template, markdown, False),
    ):
        with artifacts.replacing(target) as path:
            path.write_text(
                _environment(escape).from_string(_text(template)).render(content), "utf-8"
            )


def _environment(escape: bool) -> jinja2.Environment:
    environment = jinja2.Environment(
        autoescape=escape,
        trim_blocks=False,
        undefined=jinja2.StrictUndefined,
        keep_trailing_newline=True,
    )
    environment.filters["figure"] = figure
    environment.filters["cell"] = cell
    environment.filters["figures"] = figures
    environment.filters["removed"] = str.removeprefix
    environment.filters["symbols"] = symbols
    return environment


def _text(path: str) -> str:
    return Path(path).read_text(encoding="utf-8")


def figure(computed: str, error: str, bound: str) -> str:
    """Return a computed value with the digits that its error allows, at most six.

    Rounding, which differs from machine to machine, is told by the bound it is judged by; an error
    that changes none of the digits is left out.
    """
    if computed == "none":
        return "none"
    value, uncertain = float(computed), float(error)
    if uncertain and abs(value) <= max(uncertain, _ROUNDING):
        return upper_bound(max(abs(value), uncertain), 0.0 if bound == "none" else float(bound))
    if value == 0 or uncertain < 0.5 * 10.0 ** (floor(log10(abs(value))) - 5):
        return f"{value:.6g}"
    place = floor(log10(uncertain))
    number = f"{round(value, -place):.{max(0, -place)}f}"
    return f"{number} ± {uncertain:.0e}" if place < -3 else f"{number} ± {uncertain:.1g}"


def figures(artifact: str) -> list[str]:
    """Return the figures that show any of the artifacts, given as the ledger lists them."""
    found = []
    for path in artifact.split("; "):
        for pattern, figure_of in _FIGURES:
            if match := re.fullmatch(pattern, path):
                found.append(match.expand(figure_of))
    return list(dict.fromkeys(found))


def symbols(text: str) -> str:
    """Return text with the names of Greek letters, roots and degrees as symbols."""
    for pattern, symbol in _NOTATION:
        text = re.sub(pattern, symbol, text)
    return re.sub(_LETTERS, lambda match: unescape(f"&{match[0]};"), text)


def cell(text: str) -> str:
    """Return text for a cell of a Markdown table."""
    for character in ("\\", "|", "<", "*", "_"):
        text = text.replace(character, f"\\{character}")
    return text


if __name__ == "__main__":
    jobs.run(render_claims)
