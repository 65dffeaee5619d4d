"""The claims ledger for reading, as a page of its own and as Markdown."""

import csv
import re
from html import unescape
from pathlib import Path

import jinja2

from hopper_workflow import artifacts, jobs
from hopper_workflow.claims.finding import FAILS, HOLDS, LIMITED, UNDECIDED, VERDICTS
from hopper_workflow.claims.words import read_not_judged

# Colours of a contrast of at least 7 : 1; the mark and the words say the same without them.
STYLES = {
    HOLDS: {"css": "holds", "mark": "✓", "background": "#d7f0df", "color": "#0b4a24"},
    LIMITED: {"css": "limits", "mark": "◐", "background": "#fdeec8", "color": "#5a3d00"},
    FAILS: {"css": "fails", "mark": "✗", "background": "#fbdcd6", "color": "#7a1204"},
    UNDECIDED: {"css": "undecided", "mark": "?", "background": "#e6e6ea", "color": "#33333d"},
}
_NAMES = "sigma|psi|delta|theta|phi|mu|lambda|kappa|alpha|omega|chi|rho|epsilon|pi"
# Whole words, perhaps with an index, or one after the other as in T_phiphi.
_LETTERS = rf"(?:(?<![A-Za-z])|(?<=phi|eta))(?:{_NAMES})(?=(?:phi|theta)?(?![A-Za-z]))"
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
    environment.filters["symbols"] = symbols
    return environment


def _text(path: str) -> str:
    return Path(path).read_text(encoding="utf-8")


def figure(computed: str, error: str) -> str:
    """Return a computed value with its error, both as the ledger writes them."""
    if computed == "none":
        return "none"
    if float(error) == 0:
        return f"{float(computed):.6g}"
    return f"{float(computed):.6g} ± {float(error):.0e}"


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
