"""The report, also in a real browser: complete, whole and offline."""

import contextlib
import json
import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from selenium import webdriver
from selenium.common.exceptions import StaleElementReferenceException
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.ui import WebDriverWait

from tests.workflow.conftest import Workflow, copy

pytestmark = pytest.mark.workflow
CASES = "results/cases.csv"

FLAGS = (
    *("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    "--window-size=1600,900",
)
LOCAL = {"file", "data", "blob", "about", "chrome", "chrome-untrusted", "devtools"}


@pytest.fixture(scope="module")
def report(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report that HOPPER_REPORT names, or that of the coarse run."""
    if named := os.environ.get("HOPPER_REPORT"):
        path = Path(named).resolve()
        assert path.is_file(), f"{named} is missing: build it with: make report"
        return path
    built = request.getfixturevalue("built")
    workflow = copy(tmp_path_factory.mktemp("report") / "run", results=built.path)
    done = workflow.publish("report")
    assert done.returncode == 0, done.stderr
    return workflow.path / "results/report.html"


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[webdriver.Chrome]:
    if "HOPPER_REPORT" not in os.environ:
        pytest.skip("of a whole run, after make report: make test-report")
    program = shutil.which("chromium") or shutil.which("google-chrome")
    driver = shutil.which("chromedriver")
    if not program or not driver:
        pytest.skip("no Chromium with chromedriver: apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = program
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(flag)
    chrome = webdriver.Chrome(options=options, service=Service(driver))
    yield chrome
    chrome.quit()


class Reader:
    """Somebody who reads the report: clicks, waits, looks."""

    def __init__(self, browser: webdriver.Chrome, report: Path) -> None:
        self.browser = browser
        self.report = report.as_uri()
        browser.get(self.report)
        self.wait(lambda: self.links("Workflow"))

    def wait(self, condition, failure: str = ""):
        return WebDriverWait(self.browser, 60).until(lambda _: condition(), failure)

    def all(self, selector: str) -> list[WebElement]:
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def links(self, text: str) -> list[WebElement]:
        return [link for link in self.all("a") if link.text.strip() == text]

    def click(self, text: str) -> None:
        self.wait(lambda: self.links(text))[0].click()

    def explanation(self, link: WebElement, title: str) -> str:
        """The text behind a link, which is clicked again where the page moved under the click."""

        def shown() -> list[WebElement]:
            with contextlib.suppress(StaleElementReferenceException):  # the click has worked
                link.click()
            return self.all("nav li.prose")

        return self.wait(shown, f"no explanation of {title}")[0].text

    def home(self) -> None:
        self.all("nav nav a")[0].click()

    def value(self, expression: str):
        return self.browser.execute_script(f"return {expression}")

    def expect_quiet(self) -> None:
        """Fail if anything but the report was asked for, or an error told, since it was opened."""
        logged = [json.loads(entry["message"]) for entry in self.browser.get_log("performance")]
        addresses = {
            entry["message"]["params"]["request"]["url"]
            for entry in logged
            if entry["message"]["method"] == "Network.requestWillBeSent"
        }
        assert self.report in addresses, "requests are not recorded"
        foreign = {url for url in addresses if urlsplit(url).scheme not in LOCAL}
        assert foreign == set(), "the report is not readable offline"
        assert {url for url in addresses if url.startswith("file:")} == {self.report}
        told = self.browser.get_log("browser")
        assert [entry["message"] for entry in told if entry["level"] == "SEVERE"] == []


@pytest.fixture
def reader(browser: webdriver.Chrome, report: Path) -> Reader:
    return Reader(browser, report)


def published(report: Path) -> set[str]:
    """Every figure, page and table of cases that the workflow makes where the report belongs."""
    done = Workflow(report.parents[1]).snakemake("--summary")
    assert done.returncode == 0, done.stderr
    made = [line.split("\t")[0] for line in done.stdout.splitlines()[1:]]
    return {path for path in made if path.endswith((".png", ".html")) or path == CASES}


def test_every_figure_and_page_is_in_the_report(report: Path):
    text = report.read_text(encoding="utf-8")
    assert [path for path in sorted(published(report)) if path not in text] == []


def test_every_figure_and_page_is_found_by_its_title(reader: Reader, report: Path):
    found = {}
    for category in reader.value("Object.keys(categories)"):
        reader.home()
        reader.click(category)
        for index in range(len(reader.wait(lambda: reader.all("nav tbody tr")))):
            row = reader.wait(lambda: reader.all("nav tbody tr"))[index]
            title = row.text
            view, explain = row.find_elements(By.TAG_NAME, "a")
            if table := view.get_attribute("download"):  # a table, which nothing in a page shows
                found[title] = table
                assert view.get_attribute("href").startswith("data:")
            else:
                view.click()
                expect_whole(reader, title)
                found[title] = reader.value("app.state.resultPath")
            caption = reader.explanation(explain, title)
            assert len(caption) > len(title), f"{title}: {caption}"
            assert "{{" not in caption
            reader.click(category)
    # A table is known by its name alone.
    assert sorted(found.values()) == sorted(published(report) - {CASES} | {Path(CASES).name})
    reader.expect_quiet()


def expect_whole(reader: Reader, title: str) -> None:
    """Fail unless an image is loaded and inside the window, or a page has a table."""
    content = reader.wait(lambda: reader.all(".grow > .p-3 > img, iframe"))[0]
    if content.tag_name == "iframe":
        reader.browser.switch_to.frame(content)
        assert reader.wait(lambda: reader.all("table tr td")), title
        reader.browser.switch_to.default_content()
        return

    def settled() -> bool:
        before = content.rect
        time.sleep(0.1)
        return bool(content.get_property("naturalWidth")) and content.rect == before

    reader.wait(settled)
    width, height = reader.value("[window.innerWidth, window.innerHeight]")
    menu, box = reader.all("nav")[0].rect, content.rect
    assert box["width"] > 300, f"{title} is too small to read"
    assert box["x"] >= menu["x"] + menu["width"], f"the menu covers {title}"
    assert box["y"] >= 0, f"{title} is cut at the top"
    assert box["x"] + box["width"] <= width, f"{title} is cut at the right"
    assert box["y"] + box["height"] <= height, f"{title} is cut at the bottom"


def test_the_graph_and_the_run_time_of_every_rule_are_there(reader: Reader):
    for view in ("Workflow", "Statistics"):
        reader.click(view)
        drawing = reader.wait(lambda: reader.all(".vega-embed canvas, .vega-embed svg"))[0]
        reader.wait(lambda drawing=drawing: drawing.rect["height"] > 300)
    timed = {row["rule"] for row in reader.value("runtimes_spec.data.values")}
    assert timed == set(reader.value("Object.keys(rules)"))
    assert {"solve_radial", "plot_fig_4_5_map"} <= timed
    reader.expect_quiet()
