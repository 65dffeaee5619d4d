"""The site in a headless Chromium, as files and in two widths: quiet, whole, and searchable."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from tests.workflow.test_browser import FLAGS

pytestmark = pytest.mark.site


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[webdriver.Chrome]:
    program = shutil.which("chromium") or shutil.which("google-chrome")
    driver = shutil.which("chromedriver")
    if not program or not driver:
        pytest.skip("no Chromium with chromedriver: apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = program
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(flag)
    chrome = webdriver.Chrome(options=options, service=Service(driver))
    yield chrome
    chrome.quit()


def complaints(browser: webdriver.Chrome) -> list[str]:
    told = browser.get_log("browser")
    return [entry["message"] for entry in told if entry["level"] == "SEVERE"]


@pytest.mark.parametrize("width", [1280, 400])
def test_pages_open_quietly_and_fit(browser: webdriver.Chrome, site: Path, width: int):
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    wide, pale = [], []
    for page in sorted(site.rglob("*.html")):
        browser.get(page.as_uri())
        assert complaints(browser) == [], page.name
        assert browser.execute_script("return window.innerWidth") == width, page.name
        if browser.execute_script("return document.documentElement.scrollWidth") > width:
            wide.append(page.name)
        images = "return [...document.images].filter(i => i.complete && !i.naturalWidth).length"
        if browser.execute_script(images):
            pale.append(page.name)
    assert wide == [], "pages wider than the screen"
    assert pale == [], "pages with images that do not load"


@pytest.mark.parametrize(
    ("words", "page"), [("tangency", "theory.html"), ("flow factor", "glossary.html")]
)
def test_the_search_finds(browser: webdriver.Chrome, site: Path, words: str, page: str):
    browser.get(f"{(site / 'search.html').as_uri()}?q={words.replace(' ', '+')}")

    def found(_: webdriver.Chrome) -> list[str]:
        links = browser.find_elements(By.CSS_SELECTOR, "#search-results li a")
        return [str(link.get_attribute("href")) for link in links]

    WebDriverWait(browser, 30).until(lambda _: any(page in link for link in found(browser)))
    assert complaints(browser) == []
