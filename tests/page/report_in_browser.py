#!/usr/bin/env python3
"""The report in a browser. See test_report.sh."""

import copy
import unittest

import browser
import synthetic
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

HOSTILE = '</script><script>window.owned=1</script><img src=x onerror="window.owned=1">&amp;\u2028\'"`${1}'
# Not text: codes that the page looks up, and packed numbers.
CODES = {"low", "high", "schema", "verdict", "variable", "group"}

# Labels in one picture that run into each other or out of it.
CROWDED = """
const bad = [];
for (const picture of document.querySelectorAll('svg.plot')) {
  const frame = picture.getBoundingClientRect();
  if (!frame.width) continue;
  const texts = [...picture.querySelectorAll('text')].map(t => [t.textContent, t.getBoundingClientRect()]);
  texts.forEach(([text, r], k) => {
    const wide = r.left < frame.left - 1 || r.right > frame.right + 1;
    if (wide || r.bottom > frame.bottom + 2) bad.push('outside: ' + text);
    for (const [other, q] of texts.slice(k + 1)) {
      const beside = r.left >= q.right - 1 || q.left >= r.right - 1;
      if (!beside && r.top < q.bottom - 3 && q.top < r.bottom - 3) bad.push(text + ' over ' + other);
    }
  });
}
return bad;"""

AXES = """
const all = what => [...document.querySelectorAll(what)];
const bad = t => !t.dataset.unit ||
  (t.dataset.unit !== '1' && !t.textContent.endsWith(', ' + t.dataset.unit));
const bare = all('svg.plot, .strip').filter(p => !p.querySelector('.axis-title'));
return all('.axis-title').filter(bad).concat(bare).map(e => e.outerHTML.slice(0, 200));"""


def hostile(value, key=None):
    if isinstance(value, dict):
        return {k: hostile(v, k) for k, v in value.items()}
    if isinstance(value, list):
        return [hostile(v, key) for v in value]
    return value + HOSTILE if isinstance(value, str) and key not in CODES else value


def bare(story):
    """What is left where nothing was asked for or found."""
    story = copy.deepcopy(story)
    for key in (
        "verdict",
        "diagnose",
        "refine",
        "refined_toml",
        "orders",
        "response",
        "spectrum",
        "given_error",
    ):
        story[key] = None
    story["against"], story["candidates"] = [], []
    story["parameters"]["after"] = None
    story["compare"].update(lines=None, where=[], lag_s=None, loop=None, noise_floor=None)
    for key in story["captures"][0]["series"]:
        if key not in ("torque", "residual"):
            story["captures"][0]["series"][key] = None
    story["captures"][0]["worst"] = []
    return story


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = cls.enterClassContext(browser.chromium())
        cls.story = synthetic.story()

    def run_script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def by_id(self, name):
        return self.driver.find_element(By.ID, name)

    def window(self):
        shown = self.by_id("time-window")
        return float(shown.get_attribute("data-from")), float(shown.get_attribute("data-to"))

    def open_folds(self):
        self.run_script("document.querySelectorAll('details').forEach(d => { d.open = true; })")
        browser.settle(self.driver)

    def shown(self, expression):
        return self.driver.execute_script("return " + expression)

    def test_numbers_do_not_say_more_than_is_known(self):
        with browser.report(self.driver, synthetic.story()):
            for number, text in (
                ("probability(1)", "> 99.9 %"),
                ("probability(0)", "< 0.1 %"),
                ("percent(8.95e-7)", "< 0.001 %"),
                ("withStd(3500000, 330000)", "(3.50 ± 0.33)e6"),
            ):
                self.assertEqual(self.shown("Numbers." + number), text)

    def test_every_scale_has_two_ticks_at_least(self):
        with browser.report(self.driver, synthetic.story()):
            for span in (49, 99, 1.9, 5, 10.1):
                ticks = self.shown(f"Axes.ticksOf(Axes.scale(-{span}, {span}, 0, 100), 2.2)")
                self.assertGreaterEqual(len(ticks), 2, span)
            self.assertEqual(self.shown("Axes.scale(3, 3, 0, 100, true)(3)"), 50)

    def test_a_candidate_has_the_unit_of_its_own_picture(self):
        story = copy.deepcopy(synthetic.story())
        story["candidates"][0] |= {"value": "in phase", "value_unit": "% of torque"}
        with browser.report(self.driver, story):
            title = self.driver.find_element(
                By.CSS_SELECTOR, ".candidate .axis-title[data-axis=y]"
            )
            self.assertEqual(title.text, "in phase, % of torque")

    def test_what_the_ladder_leaves_is_said(self):
        with browser.report(self.driver, synthetic.story()):
            said = self.driver.find_element(By.ID, "refined-advice").text
            self.assertIn("nothing in the catalogue explains the residual", said)

    def test_is_quiet_and_asks_for_nothing(self):
        with browser.report(self.driver, self.story) as file:
            self.open_folds()
            self.assertEqual(browser.requests(self.driver), [file.as_uri()])
            self.assertEqual(browser.complaints(self.driver), [])

    def test_hostile_text_stays_text(self):
        with browser.report(self.driver, hostile(self.story)):
            self.open_folds()
            self.assertIsNone(self.run_script("return window.owned"))
            self.assertEqual(self.run_script("return document.querySelectorAll('img').length"), 0)
            self.assertEqual(self.run_script("return document.scripts.length"), 4)
            self.assertIn("<img src=x", self.by_id("title").text)
            self.assertIn("<img src=x", self.by_id("worst-1").text)
            self.assertLessEqual(
                self.run_script("return document.documentElement.scrollWidth"), 1280
            )
            self.assertEqual(browser.complaints(self.driver), [])

    def test_fits_its_window(self):
        for width in (1280, 820):
            for dark in (False, True):
                with self.subTest(width=width, dark=dark), browser.report(
                    self.driver, self.story, width, dark
                ):
                    self.open_folds()
                    self.assertLessEqual(
                        self.run_script("return document.documentElement.scrollWidth"), width
                    )
                    self.assertEqual(self.run_script(CROWDED), [])
                    theme = self.run_script("return document.documentElement.dataset.theme")
                    self.assertEqual(theme, "dark" if dark else "light")

    def test_every_axis_has_a_unit(self):
        with browser.report(self.driver, self.story):
            self.open_folds()
            self.assertEqual(self.run_script(AXES), [])
            self.assertGreater(
                self.run_script("return document.querySelectorAll('.axis-title').length"), 25
            )

    def test_shows_the_numbers_of_the_story(self):
        with browser.report(self.driver, self.story):
            exact = lambda name: float(self.by_id(name).get_attribute("data-value"))
            self.assertEqual(self.by_id("verdict").text, "unknown")
            self.assertEqual(
                (exact("error-now"), exact("error-after"), exact("noise-floor")),
                (0.694, 0.0282, 0.0057),
            )
            best = self.driver.find_element(By.CSS_SELECTOR, ".candidate")
            self.assertEqual(best.get_attribute("data-effect"), "coulomb")
            self.assertIn("36.60 ± 0.77", best.text)
            self.assertEqual(
                len(self.driver.find_elements(By.CSS_SELECTOR, "#ladder rect.rung")), 5
            )
            row = self.driver.find_element(
                By.CSS_SELECTOR, "#parameter-table [data-parameter='coulomb.torque']"
            )
            self.assertIn("13.67 ± 0.54", row.text)
            self.assertIn("trapezoid:stroke=0.2", self.by_id("next-experiment").text)

    def test_says_nothing_of_what_is_not_there(self):
        with browser.report(self.driver, bare(self.story)):
            self.assertEqual(browser.complaints(self.driver), [])
            sections = self.run_script(
                "return [...document.querySelectorAll('main > section')].map(s => s.id)"
            )
            self.assertEqual(
                sections, ["verdict-section", "time", "parameters", "next", "provenance"]
            )
            self.assertEqual(self.by_id("verdict").text, "not diagnosed yet")

    def test_worst_place_by_keyboard(self):
        with browser.report(self.driver, self.story):
            before = self.window()
            for _ in range(40):
                ActionChains(self.driver).send_keys(Keys.TAB).perform()
                if self.driver.switch_to.active_element.get_attribute("id") == "worst-1":
                    break
            focused = self.driver.switch_to.active_element
            self.assertEqual(focused.get_attribute("id"), "worst-1")
            self.assertNotEqual(focused.value_of_css_property("outline-style"), "none")
            ActionChains(self.driver).send_keys(Keys.ENTER).perform()
            after = self.window()
            self.assertLess(after[1] - after[0], 0.2 * (before[1] - before[0]))
            self.assertLessEqual(after[0], float(focused.get_attribute("data-from")))
            self.assertGreaterEqual(after[1], float(focused.get_attribute("data-to")))

    def test_correlation_by_keyboard(self):
        with browser.report(self.driver, self.story):
            self.run_script("document.querySelector('#correlation [tabindex=\"0\"]').focus()")
            ActionChains(self.driver).send_keys(Keys.ARROW_DOWN).perform()
            self.assertIn(
                "constant_torque.torque and inertia", self.by_id("correlation-reading").text
            )

    def test_copies(self):
        with browser.report(self.driver, self.story):
            button = self.by_id("command-1-copy")
            self.run_script(
                "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", button
            )
            button.click()
            browser.wait(lambda: button.text == "Copied", "the button says that it copied")

    def test_the_theme_changes_by_button(self):
        with browser.report(self.driver, self.story):
            ground = lambda: self.driver.find_element(By.TAG_NAME, "body").value_of_css_property(
                "background-color"
            )
            light = ground()
            self.by_id("theme").click()
            self.assertNotEqual(ground(), light)
            self.assertEqual(browser.complaints(self.driver), [])


if __name__ == "__main__":
    unittest.main(verbosity=1)
