"""The report in a real browser: complete, whole and offline."""

import json
import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.ui import WebDriverWait

pytestmark = pytest.mark.workflow

FLAGS = (
    *("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    "--window-size=1600,900",
)
LOCAL = {"file", "data", "blob", "about", "chrome", "chrome-untrusted", "devtools"}


@pytest.fixture(scope="module")
def report(request: pytest.FixtureRequest) -> Path:
    """The report that HOPPER_REPORT names, or that of the coarse run."""
    if named := os.environ.get("HOPPER_REPORT"):
        path = Path(named).resolve()
        assert path.is_file(), f"{named} is missing: build it with: make report"
        return path
    built = request.getfixturevalue("built")
    done = built.publish("report")
    assert done.returncode == 0, done.stderr
    return Path(built.path / "results/report.html")


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[webdriver.Chrome]:
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
        browser.get(report.as_uri())
        self.wait(lambda: self.links("Workflow"))
        self.requests: list[str] = []
        self.errors: list[str] = []

    def wait(self, condition):
        return WebDriverWait(self.browser, 30).until(lambda _: condition())

    def links(self, text: str) -> list[WebElement]:
        return [a for a in self.browser.find_elements(By.TAG_NAME, "a") if a.text.strip() == text]

    def click(self, text: str) -> None:
        self.wait(lambda: self.links(text))[0].click()

    def home(self) -> None:
        self.browser.find_element(By.CSS_SELECTOR, "nav nav a").click()

    def rows(self) -> list[WebElement]:
        return self.browser.find_elements(By.CSS_SELECTOR, "nav tbody tr")

    def shown(self) -> str:
        """Path of the result on display."""
        return str(self.browser.execute_script("return app.state.resultPath"))

    def variable(self, name: str):
        return self.browser.execute_script(f"return {name}")

    def listen(self) -> None:
        """Collect the addresses asked for and the errors told since the last call."""
        for entry in self.browser.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                self.requests.append(message["params"]["request"]["url"])
        logged = self.browser.get_log("browser")
        self.errors += [entry["message"] for entry in logged if entry["level"] == "SEVERE"]


@pytest.fixture(scope="module")
def reader(browser: webdriver.Chrome, report: Path) -> Reader:
    return Reader(browser, report)


def published(report: Path) -> set[str]:
    """Every figure, and every page the workflow made, beside the report."""
    root = report.parents[1]
    pages = set((root / "results").rglob("*.html")) - {report}
    return {str(path.relative_to(root)) for path in {*(root / "figures").glob("*.png"), *pages}}


def test_every_figure_and_page_is_found_by_its_title(reader: Reader, report: Path):
    found, titles = {}, set()
    reader.wait(lambda: reader.variable("Object.keys(categories)"))
    for category in reader.variable("Object.keys(categories)"):
        reader.home()
        reader.click(category)
        count = len(reader.wait(reader.rows))
        for index in range(count):
            row = reader.wait(reader.rows)[index]
            title = row.text
            view, explain = row.find_elements(By.TAG_NAME, "a")
            view.click()
            content = reader.wait(
                lambda: reader.browser.find_elements(By.CSS_SELECTOR, ".grow > .p-3 > img, iframe")
            )[0]
            assert_whole(reader, content, title)
            found[reader.shown()] = title
            titles.add(title)
            explain.click()
            caption = reader.wait(
                lambda: reader.browser.find_elements(By.CSS_SELECTOR, "nav li.prose")
            )[0].text
            assert "{{" not in caption
            assert len(caption) > 80, f"{title}: {caption}"
            reader.click(category)
    reader.listen()
    assert set(found) == published(report)
    assert len(titles) == len(found), "two results have the same title"


def assert_whole(reader: Reader, content: WebElement, title: str) -> None:
    """Fail unless an image is loaded and inside the window, or a page has a table."""
    if content.tag_name == "iframe":
        reader.browser.switch_to.frame(content)
        assert reader.browser.find_elements(By.CSS_SELECTOR, "table tr td"), title
        reader.browser.switch_to.default_content()
        return

    def settled() -> bool:
        before = content.rect
        time.sleep(0.1)
        return bool(content.get_property("naturalWidth")) and content.rect == before

    reader.wait(settled)
    width, height = reader.variable("[window.innerWidth, window.innerHeight]")
    menu = reader.browser.find_element(By.TAG_NAME, "nav").rect
    box = content.rect
    assert box["width"] > 300, f"{title} is too small to read"
    assert box["x"] >= menu["x"] + menu["width"], f"the menu covers {title}"
    assert box["y"] >= 0, f"{title} is cut at the top"
    assert box["x"] + box["width"] <= width, f"{title} is cut at the right"
    assert box["y"] + box["height"] <= height, f"{title} is cut at the bottom"


def test_the_graph_and_the_run_time_of_every_rule_are_there(reader: Reader):
    reader.home()
    reader.click("Workflow")
    drawing = ".vega-embed canvas, .vega-embed svg"
    assert reader.wait(lambda: reader.browser.find_elements(By.CSS_SELECTOR, drawing))
    reader.click("Statistics")
    assert reader.wait(lambda: reader.browser.find_elements(By.CSS_SELECTOR, drawing))
    timed = {row["rule"] for row in reader.variable("runtimes_spec.data.values")}
    assert timed == set(reader.variable("Object.keys(rules)"))
    assert {"solve_radial", "plot_fig_4_5_map"} <= timed
    reader.listen()


def test_nothing_is_fetched_and_no_error_is_told(reader: Reader, report: Path):
    reader.listen()
    assert report.as_uri() in reader.requests, "requests are not recorded"
    assert {url for url in reader.requests if urlsplit(url).scheme not in LOCAL} == set()
    assert {url for url in reader.requests if url.startswith("file:")} == {report.as_uri()}
    assert reader.errors == []
