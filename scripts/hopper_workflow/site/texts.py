"""Pages of text: files as they are, and sections of README.md put together."""

import re
from pathlib import Path

from hopper_workflow.site.source import SiteError, Source

# Page, its title, and the sections of README.md it consists of.
_SECTIONS = (
    (
        "start.md",
        "Start in five minutes",
        ("Two commands", "A hopper of your own", "Use the package", "Report and crate"),
    ),
    ("verdict.md", "The verdict in a page", ("The verdict", "Two formulations")),
    (
        "howto.md",
        "How to",
        ("Change a number", "Check the figures", "Use the workflow in your own", "Layout"),
    ),
)
_FILES = {"changelog.md": "CHANGELOG.md", "contributing.md": "CONTRIBUTING.md",
          "configuring.md": "config/README.md"}  # fmt: skip
# Links of README.md, as they are in the site.
_LINKS = {"CONTRIBUTING.md": "contributing.md", "config/README.md": "configuring.md"}
_DOWNLOADS = ("CITATION.cff",)
_PICTURE = re.compile(r"\]\(gallery/(\w+[.]png)\)")


def write(source: Source, root: Path) -> None:
    """Write all pages that are texts of the project.

    Raises
    ------
    SiteError
        If README.md lacks a section.
    """
    for folder in ("docs", "docs/site"):
        for path in sorted((root / folder).glob("*.md")):
            if path.name != "references.md":  # works.py adds to it
                source.write(path.name, _with_pictures(source, root, path))
    for name, origin in _FILES.items():
        source.copy(name, root / origin)
    for name in _DOWNLOADS:
        source.copy(name, root / name)
    sections = _sections((root / "README.md").read_text(encoding="utf-8"))
    for name, title, titles in _SECTIONS:
        missing = [one for one in titles if one not in sections]
        if missing:
            raise SiteError(
                f"README.md has no section '{missing[0]}', of which {name} is made: "
                "change the list in scripts/hopper_workflow/site/texts.py"
            )
        source.write(name, "\n".join([f"# {title}\n", *(sections[one] for one in titles)]))


def _with_pictures(source: Source, root: Path, path: Path) -> str:
    """Return a page with its pictures from the run, or from docs/gallery before there is one."""
    text = path.read_text(encoding="utf-8")
    for picture in sorted(set(_PICTURE.findall(text))):
        made = root / "figures" / picture
        source.copy(
            f"figures/{picture}", made if made.exists() else root / "docs/gallery" / picture
        )
    return _PICTURE.sub(r"](figures/\1)", text)


def _sections(text: str) -> dict[str, str]:
    """Return the sections of a text by their titles, with links as the site has them."""
    parts = re.split(r"^(?=## )", text, flags=re.MULTILINE)[1:]
    return {part.partition("\n")[0].removeprefix("## "): _relinked(part) for part in parts}


def _relinked(text: str) -> str:
    for old, new in _LINKS.items():
        text = text.replace(f"]({old})", f"]({new})")
    return text.replace("](docs/", "](")
