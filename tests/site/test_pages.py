"""The built site: complete, without a broken link, and of a size that is quick to load."""

import ast
import re
from collections import defaultdict
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
import yaml

from hopper_workflow import entries
from tests.site.conftest import ROOT

pytestmark = pytest.mark.site


class Page(HTMLParser):
    """The links, sources and ids of a page."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append(value)
            if name == "id" and value:
                self.ids.add(value)


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[Path, Page]:
    return {path: Page(path) for path in site.rglob("*.html")}


def test_no_link_is_broken(pages: dict[Path, Page]):
    broken = defaultdict(list)
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            ids = pages[target].ids if target in pages else set()
            found = target.is_file() and (not parts.fragment or target not in pages)
            if not found and parts.fragment not in ids:
                broken[link].append(path.name)
    assert dict(broken) == {}


def test_nothing_is_loaded_from_elsewhere(pages: dict[Path, Page], site: Path):
    text = "".join(path.read_text(encoding="utf-8") for path in pages)
    assert (
        re.findall(r'<(?:script|img|link|iframe)[^>]+(?:src|href)="(?:https?:)?//[^"]+', text) == []
    )


def test_every_figure_has_its_page_with_picture_and_data(site: Path):
    config = yaml.safe_load((ROOT / "config.yaml").read_text(encoding="utf-8"))
    for drawing in entries.drawings(config):
        page = site / f"gallery/{drawing.figure}.html"
        assert page.is_file(), f"{drawing.figure} has no page"
        text = page.read_text(encoding="utf-8")
        assert f"_images/{drawing.figure}.png" in text
        assert "{{" not in text
        assert "<dt" in text
        if drawing.figure != "fig_1_1":
            assert re.search(r'href="[^"]+[.](nc|csv)"', text), f"{drawing.figure} has no data"


def public_functions() -> set[str]:
    found = set()
    for path in (ROOT / "src/hopper").rglob("[a-z]*.py"):
        module = ".".join(path.relative_to(ROOT / "src").with_suffix("").parts)
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
                found.add(f"{module}.{node.name}")
    return found


def test_every_public_function_is_in_the_api(pages: dict[Path, Page], site: Path):
    shown = {name for path, page in pages.items() if path.parent.name == "api" for name in page.ids}
    assert sorted(public_functions() - shown) == []


def test_every_key_of_the_configuration_is_in_the_reference(site: Path):
    text = (site / "configuration.html").read_text(encoding="utf-8")
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
    assert [key for key in schema["properties"] if f">{key}<" not in text] == []


def test_the_site_is_small(site: Path):
    assert sum(path.stat().st_size for path in site.rglob("*") if path.is_file()) <= 25e6
