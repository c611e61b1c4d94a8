"""A person at the studio: presses, types, reads what is on the page."""

import hashlib
import pathlib
import time

import browser
from selenium.common.exceptions import StaleElementReferenceException
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


class User:
    def __init__(self, driver, url):
        self.driver, self.url = driver, url
        browser.look(driver, 1280)
        driver.get(url)
        browser.wait(lambda: self.all("#title"), "the story")

    def all(self, what):
        return self.driver.find_elements(By.CSS_SELECTOR, what)

    def by_id(self, name):
        return self.driver.find_element(By.ID, name)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    # News may build an element anew between finding and using it.
    def patiently(self, work):
        for last in (False, False, False, True):
            try:
                return work()
            except StaleElementReferenceException:
                if last:
                    raise

    def press(self, name):
        def once():
            element = self.by_id(name)
            middle = "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})"
            self.run(middle, element)
            element.click()

        browser.wait(lambda: self.by_id(name).is_enabled(), f"#{name} can be pressed", 60)
        self.patiently(once)

    def type(self, name, text):
        def once():
            field = self.by_id(name)
            field.send_keys(Keys.CONTROL + "a")
            field.send_keys(text, Keys.ENTER)

        self.patiently(once)

    def text(self, name):
        return self.patiently(lambda: self.by_id(name).text)

    def number(self, name):
        """The exact number; what is shown must be it, rounded."""

        def once():
            element = self.by_id(name)
            return element.get_attribute("data-value"), element.text

        exact, shown = self.patiently(once)
        if exact is None:
            return None
        if shown.endswith(" %"):
            assert abs(float(shown[:-2]) / 100 - float(exact)) <= 0.006 * abs(float(exact)), shown
        return float(exact)

    def error(self):
        return self.number("error-now")

    def verdict(self):
        return self.patiently(lambda: self.by_id("verdict").get_attribute("data-verdict"))

    def value(self, name):
        return float(
            self.patiently(lambda: self.by_id("value-" + name).get_attribute("data-value"))
        )

    def terms(self):
        return self.run(
            "return [...document.querySelectorAll('#model .term')].map("
            "t => t.dataset.effect + (t.classList.contains('off') ? ' (off)' : ''))"
        )[1:]

    def window(self):
        shown = self.by_id("time-window")
        return tuple(float(shown.get_attribute(k)) for k in ("data-from", "data-to"))

    def open_law(self):
        self.run("document.getElementById('law').open = true")

    def busy(self):
        return bool(self.all("#busy-bar"))

    def at_rest(self):
        return not self.busy() and self.by_id("studio").get_attribute("data-told") == "true"

    def quiet(self, seconds=90):
        """Until nothing is being computed, nor about to be, and what is shown is the latest."""
        calm, end = 0, time.monotonic() + seconds
        while calm < 4:
            calm = calm + 1 if self.at_rest() else 0
            if time.monotonic() > end:
                raise AssertionError("still at work: " + self.text("busy"))
            time.sleep(0.1)

    def until_diagnosed(self, seconds=90):
        browser.wait(lambda: self.verdict() != "none", "a verdict", seconds)
        self.quiet(seconds)
        browser.settle(self.driver)

    def picture(self, strip):
        """What a plot over time shows, as one word."""
        browser.settle(self.driver)
        drawn = self.run(
            "return [...document.querySelectorAll(`#strip-${arguments[0]} canvas`)]"
            ".map(c => c.toDataURL()).join()",
            strip,
        )
        return hashlib.sha256(drawn.encode()).hexdigest()

    def save(self, button, folder):
        """Presses a link that downloads; the file."""
        folder = pathlib.Path(folder)
        before = set(folder.iterdir())
        self.driver.execute_cdp_cmd(
            "Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)}
        )
        self.press(button)
        fresh = lambda: [
            f for f in folder.iterdir() if f not in before and f.suffix in (".toml", ".html")
        ]
        browser.wait(fresh, "the file of #" + button, 60)
        return fresh()[0]
