#!/usr/bin/env python3
"""The studio in a browser. See test_studio.sh."""

import tempfile
import unittest

import browser
import fake_studio
from selenium.common.exceptions import StaleElementReferenceException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


class Studio(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = cls.enterClassContext(browser.chromium())

    def setUp(self):
        self.server = fake_studio.serve()
        self.session = self.server.session
        browser.complaints(self.driver)
        self.open(1280)

    def tearDown(self):
        self.driver.get("about:blank")
        self.server.shutdown()
        self.server.server_close()

    def open(self, width, dark=False):
        browser.look(self.driver, width, dark)
        self.driver.get(f"http://127.0.0.1:{self.server.server_port}/t/")
        browser.wait(lambda: self.driver.find_elements(By.ID, "title"), "the story")
        browser.settle(self.driver)

    def by_id(self, name):
        return self.driver.find_element(By.ID, name)

    def click(self, name):
        # News may build the panel anew between finding and clicking.
        for last in (False, False, True):
            try:
                self.driver.execute_script(
                    "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})",
                    self.by_id(name),
                )
                return self.by_id(name).click()
            except StaleElementReferenceException:
                if last:
                    raise

    def value(self, name):
        return self.driver.execute_script(
            "return document.getElementById(arguments[0]).value", name
        )

    def asked(self, **action):
        browser.wait(lambda: action in self.session.asked, f"{action} in {self.session.asked}")

    def shown(self, name, text):
        browser.wait(lambda: text in self.by_id(name).text, f"{text!r} in #{name}")

    def press(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()

    def undo_keys(self):
        ActionChains(self.driver).key_down(Keys.CONTROL).send_keys("z").key_up(
            Keys.CONTROL
        ).perform()

    def test_adds_turns_and_removes_terms(self):
        self.click("effect-add")
        self.asked(action="add", effect="coulomb")
        self.shown("model", "coulomb")
        self.click("term-on-1")
        self.asked(action="turn", index=1, on=False)
        browser.wait(
            lambda: "off"
            in self.driver.find_element(By.CSS_SELECTOR, ".term[data-index='1']").get_attribute(
                "class"
            ),
            "the term is off",
        )
        self.click("term-remove-1")
        self.asked(action="remove", index=1)
        browser.wait(lambda: not self.driver.find_elements(By.ID, "term-on-1"), "the term is gone")

    def test_adds_a_candidate_of_the_diagnosis(self):
        self.click("add-viscous")
        self.asked(action="add", effect="viscous")

    def test_says_why_an_effect_cannot_be_added(self):
        self.by_id("effect-choice").send_keys("stribeck")
        self.shown("effect-why", "no Coulomb friction")
        self.assertFalse(self.by_id("effect-add").is_enabled())

    def test_adds_a_law(self):
        self.driver.execute_script("document.getElementById('law').open = true")
        self.by_id("law-name").send_keys("cubic")
        self.by_id("law-text").send_keys("k*theta^3", Keys.ENTER)
        self.asked(action="add", name="cubic", law="k*theta^3")

    def test_sets_a_number(self):
        field = self.by_id("value-inertia")
        field.clear()
        field.send_keys("93,5", Keys.ENTER)
        self.asked(action="set", name="inertia", value=93.5)
        self.click("fixed-inertia")
        self.asked(action="fix", name="inertia", fixed=True)

    def test_arrows_move_the_second_digit(self):
        self.click("value-inertia")
        self.press(Keys.ARROW_UP, Keys.ARROW_UP)
        self.asked(action="set", name="inertia", value=97.2)

    def test_refuses_what_is_no_number(self):
        field = self.by_id("value-inertia")
        field.clear()
        field.send_keys("heavy", Keys.ENTER)
        self.assertEqual(field.get_attribute("aria-invalid"), "true")
        self.assertEqual(self.session.asked, [])

    def test_typing_survives_news(self):
        field = self.by_id("value-inertia")
        field.clear()
        field.send_keys("12")
        self.session.do_set({"name": "constant_torque.torque", "value": 7.0})
        browser.wait(lambda: self.value("value-constant_torque.torque") == "7", "the news")
        self.press("3", Keys.ENTER)
        self.asked(action="set", name="inertia", value=123)
        self.assertEqual(len(self.session.asked), 1)

    def test_undo_by_keyboard_but_not_while_typing(self):
        self.click("effect-add")
        self.shown("do-undo", "coulomb")
        self.click("value-inertia")
        self.undo_keys()
        self.click("title")
        self.undo_keys()
        self.asked(action="undo")
        self.assertEqual(self.session.asked.count({"action": "undo"}), 1)
        self.shown("do-redo", "coulomb")

    def test_shows_progress_and_stops(self):
        self.click("do-diagnose")
        self.shown("busy", "backlash")
        self.assertEqual(self.by_id("busy-bar").get_attribute("value"), "0.4")
        self.assertIn("5 s left", self.by_id("busy-left").text)
        self.assertFalse(self.by_id("do-fit").is_enabled())
        self.click("do-stop")
        browser.wait(lambda: self.by_id("do-fit").is_enabled(), "free again")

    def test_errors_are_an_alert(self):
        alert = self.by_id("error")
        self.assertEqual(alert.get_attribute("role"), "alert")
        self.session.change(error="no solution <b>here</b>")
        self.shown("error", "no solution <b>here</b>")
        self.session.change(error=None)
        browser.wait(lambda: not alert.is_displayed(), "no error any more")

    def test_a_refusal_is_shown(self):
        self.driver.execute_script("document.getElementById('law').open = true")
        self.by_id("law-name").send_keys("stribeck")
        self.by_id("law-text").send_keys("k*v", Keys.ENTER)
        self.shown("error", "no Coulomb friction")
        self.session.change(busy=None)
        self.assertTrue(self.by_id("error").is_displayed())

    def test_takes_captures(self):
        with tempfile.NamedTemporaryFile(suffix=" <b>run<b>.csv", prefix="second") as file:
            file.write(b"time_s\n")
            file.flush()
            self.by_id("capture-file").send_keys(file.name)
            self.shown("captures", "<b>run<b>.csv")
        self.click("capture-on-0")
        self.asked(action="capture", file="axis.csv", on=False)

    def test_simulates_and_runs_the_next_experiment(self):
        self.click("simulate-next")
        self.asked(action="experiment")
        self.click("can-run")
        self.asked(action="run", experiment="trapezoid:stroke=0.2,cycles=2")
        self.shown("can-rows", "200 rows")
        browser.settle(self.driver)
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, "#live svg .line")), 2)

    def test_the_window_in_time_survives_a_new_story(self):
        self.click("zoom-in")
        before = self.by_id("time-window").get_attribute("data-from")
        self.click("effect-add")
        self.shown("do-undo", "coulomb")
        browser.settle(self.driver)
        self.assertEqual(self.by_id("time-window").get_attribute("data-from"), before)

    def test_the_place_on_the_page_survives_a_new_story(self):
        self.click("add-viscous")
        before = self.driver.execute_script("return scrollY")
        self.shown("do-undo", "viscous")
        browser.settle(self.driver)
        self.assertAlmostEqual(self.driver.execute_script("return scrollY"), before, delta=2)
        self.assertEqual(self.driver.switch_to.active_element.get_attribute("id"), "add-viscous")

    def test_the_state_survives_a_reload(self):
        self.click("effect-add")
        self.shown("model", "coulomb")
        self.driver.refresh()
        browser.wait(
            lambda: self.driver.find_elements(By.ID, "value-coulomb.torque"), "the model as it was"
        )

    def test_says_that_the_connection_is_lost(self):
        state = lambda: self.by_id("connection").get_attribute("data-state")
        self.assertEqual(state(), "open")
        port = self.server.server_port
        self.server.shutdown()
        self.server.server_close()
        self.session.change()
        browser.wait(lambda: state() == "lost", "the loss is noticed")
        self.server = fake_studio.serve(port, self.session)
        browser.wait(lambda: state() == "open", "back again", seconds=20)

    def test_fits_its_window(self):
        self.session.do_diagnose(None)
        self.session.do_run(None)
        for width in (1280, 820):
            for dark in (False, True):
                with self.subTest(width=width, dark=dark):
                    self.open(width, dark)
                    self.assertLessEqual(
                        self.driver.execute_script("return document.documentElement.scrollWidth"),
                        width,
                    )
                    self.assertEqual(browser.complaints(self.driver), [])


if __name__ == "__main__":
    unittest.main(verbosity=1)
