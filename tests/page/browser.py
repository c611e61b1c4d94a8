"""A Chromium without a window, fresh for every test class."""

import contextlib
import json
import pathlib
import tempfile
import time

import assemble
from selenium import webdriver
from selenium.common.exceptions import NoSuchElementException, StaleElementReferenceException
from selenium.webdriver.chrome.service import Service

FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-dev-shm-usage",
    "--force-device-scale-factor=1",
]


@contextlib.contextmanager
def chromium():
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        options = webdriver.ChromeOptions()
        for flag in FLAGS + ["--user-data-dir=" + folder]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        try:
            yield driver
        finally:
            driver.quit()


def look(driver, width, dark=False, height=1000):
    driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False},
    )
    driver.execute_cdp_cmd(
        "Emulation.setEmulatedMedia",
        {"features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]},
    )


@contextlib.contextmanager
def report(driver, story, width=1280, dark=False):
    """The report of a story, opened from a file and drawn; gives the file."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "report.html"
        file.write_text(assemble.assemble({"mode": "report", "story": story}), encoding="utf-8")
        look(driver, width, dark)
        driver.get_log("performance")
        driver.get(file.as_uri())
        settle(driver)
        yield file


def settle(driver):
    """Until what is to be drawn is drawn: plots appear two frames after they have a place."""
    driver.execute_async_script(
        "const done = arguments[0]; let n = 0;"
        "const step = () => ++n < 6 ? requestAnimationFrame(step) : done(); step();"
    )


def complaints(driver):
    return [
        entry["message"]
        for entry in driver.get_log("browser")
        if entry["level"] in ("SEVERE", "WARNING")
    ]


def requests(driver):
    """Addresses that the page asked for, data within the page aside."""
    events = (json.loads(e["message"])["message"] for e in driver.get_log("performance"))
    urls = (
        e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"
    )
    return [url for url in urls if not url.startswith("data:")]


def there(condition):
    try:
        return condition()
    except (NoSuchElementException, StaleElementReferenceException):
        return False  # just being built anew


def wait(condition, what, seconds=10):
    end = time.monotonic() + seconds
    while not there(condition):
        if time.monotonic() > end:
            raise AssertionError("waited in vain: " + what)
        time.sleep(0.05)
