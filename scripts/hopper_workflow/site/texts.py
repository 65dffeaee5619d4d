"""Pages of text: files as they are, with links and pictures as the site has them."""

import re
from pathlib import Path

from hopper_workflow.site.source import Source

_FILES = {"changelog.md": "CHANGELOG.md", "contributing.md": "CONTRIBUTING.md",
          "configuring.md": "config/README.md"}  # fmt: skip
# Links to files outside of docs, as they are in the site.
_LINKS = {
    "../CONTRIBUTING.md": "contributing.md",
    "../config/README.md": "configuring.md",
    "../CITATION.cff": "CITATION.cff",
}
_DOWNLOADS = ("CITATION.cff",)
_PICTURE = re.compile(r"\]\(gallery/(\w+[.]png)\)")


def write(source: Source, root: Path) -> None:
    """Write all pages that are texts of the project."""
    for folder in ("docs", "docs/site"):
        for path in sorted((root / folder).glob("*.md")):
            if path.name != "references.md":  # works.py adds to it
                source.write(path.name, _as_in_the_site(source, root, path))
    for name, origin in _FILES.items():
        source.copy(name, root / origin)
    for name in _DOWNLOADS:
        source.copy(name, root / name)


def _as_in_the_site(source: Source, root: Path, path: Path) -> str:
    """Return a page with its pictures from the run, or from docs/gallery before there is one."""
    text = path.read_text(encoding="utf-8")
    for picture in sorted(set(_PICTURE.findall(text))):
        made = root / "figures" / picture
        source.copy(
            f"figures/{picture}", made if made.exists() else root / "docs/gallery" / picture
        )
    for old, new in _LINKS.items():
        text = text.replace(f"]({old})", f"]({new})")
    return _PICTURE.sub(r"](figures/\1)", text)
