#!/usr/bin/env python3
"""The plots over time in a browser. See test_time.sh."""

import unittest

import axis
import browser
import synthetic
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

SPIKE, ROWS, STEP = 61813, 100000, 1e-3

# Dark pixels in the topmost eighth of the torque plot, right of its axis.
INK_AT_TOP = """
const canvas = document.querySelector('#strip-torque canvas');
const [width, height] = [canvas.width - 60, Math.round(canvas.height / 8)];
const box = canvas.getContext('2d').getImageData(60, 0, width, height).data;
let ink = 0;
for (let k = 0; k < box.length; k += 4) {
  const dark = Math.max(box[k], box[k + 1], box[k + 2]) < 90;
  if (dark && box[k + 3] > 60) ++ink;
}
return ink;"""

MOST = """
const mode = JSON.parse(document.getElementById('servoid-mode').textContent);
const s = Series.decode(mode.story.captures[0].series.torque);
return Math.max(...Series.rows([s], arguments[0], arguments[1], arguments[2]).map(r => r[1]));"""


class OverTime(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = cls.enterClassContext(browser.chromium())
        cls.long = synthetic.story(rows=ROWS, step=STEP, spike_at=SPIKE)
        cls.short = synthetic.story()

    def window(self):
        shown = self.driver.find_element(By.ID, "time-window")
        return float(shown.get_attribute("data-from")), float(shown.get_attribute("data-to"))

    def plot(self):
        plot = self.driver.find_element(By.CSS_SELECTOR, "#strip-torque .strip-body")
        self.driver.execute_script(
            "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", plot
        )
        return plot

    def drag(self, start, end, key=None):
        hand = ActionChains(self.driver)
        hand = hand.key_down(key) if key else hand
        hand.move_to_element_with_offset(self.plot(), start, 0).click_and_hold().move_by_offset(
            end - start, 0
        ).release()
        (hand.key_up(key) if key else hand).perform()

    def test_a_single_sample_peak_is_seen(self):
        with browser.report(self.driver, self.long):
            self.assertGreater(self.driver.execute_script(INK_AT_TOP), 3)
            for columns in (300, 777, 1180):
                most = self.driver.execute_script(MOST, 0, ROWS * STEP, columns)
                self.assertGreater(most, 350, f"{columns} columns")
            aside = self.driver.execute_script(MOST, 0, SPIKE * STEP - 0.1, 1000)
            self.assertLess(aside, 200)

    def test_a_gap_stays_a_gap(self):
        rows = self.driver.execute_script
        with browser.report(self.driver, self.short):
            gap = axis.series([1.0, 2.0, None, None, 5.0, 6.0], 1.0)
            got = rows(
                "const rows = Series.rows([Series.decode(arguments[0])], 0, 5, 60);"
                "return rows.map(r => [r[0], Number.isNaN(r[1]) ? 'gap' : r[1]])",
                gap,
            )
            self.assertEqual([v for _, v in got[::2]][2:4], ["gap", "gap"])
            self.assertAlmostEqual(got[0][1], 1.0, places=3)
            self.assertAlmostEqual(got[-1][1], 6.0, places=3)

    def test_buckets_show_least_and_most(self):
        values = [0.0, 9.0, -4.0, 1.0] * 50
        with browser.report(self.driver, self.short):
            got = self.driver.execute_script(
                "return Series.rows([Series.decode(arguments[0])], 0, 199, 10).map(r => r[1])",
                axis.series(values, 1.0, bucket=4),
            )
            self.assertAlmostEqual(max(got), 9.0, places=3)
            self.assertAlmostEqual(min(got), -4.0, places=3)

    def test_zoom_pan_and_reset_by_hand(self):
        with browser.report(self.driver, self.short):
            whole = self.window()
            self.drag(-200, 100)
            near = self.window()
            self.assertLess(near[1] - near[0], 0.5 * (whole[1] - whole[0]))
            self.drag(0, 150, Keys.SHIFT)
            moved = self.window()
            self.assertAlmostEqual(moved[1] - moved[0], near[1] - near[0], places=6)
            self.assertLess(moved[0], near[0])
            ActionChains(self.driver).double_click(self.plot()).perform()
            self.assertEqual(self.window(), whole)

    def touch(self, kind, *xs):
        box = self.plot().rect
        top = self.driver.execute_script(
            "return arguments[0].getBoundingClientRect().top", self.plot()
        )
        points = [{"x": box["x"] + x, "y": top + 50, "id": k} for k, x in enumerate(xs)]
        self.driver.execute_cdp_cmd(
            "Input.dispatchTouchEvent", {"type": kind, "touchPoints": points}
        )

    def test_two_fingers_pan_and_pinch(self):
        with browser.report(self.driver, self.short):
            self.driver.find_element(By.ID, "zoom-in").click()
            near = self.window()
            self.touch("touchStart", 400, 500)
            for x in range(10, 110, 10):
                self.touch("touchMove", 400 + x, 500 + x)
            self.touch("touchEnd")
            moved = self.window()
            self.assertLess(moved[0], near[0] - 0.2)
            self.assertAlmostEqual(
                moved[1] - moved[0], near[1] - near[0], delta=0.1 * (near[1] - near[0])
            )
            self.touch("touchStart", 400, 500)
            for x in range(10, 110, 10):
                self.touch("touchMove", 400 - x, 500 + x)
            self.touch("touchEnd")
            self.assertLess(self.window()[1] - self.window()[0], 0.6 * (moved[1] - moved[0]))

    def test_zoom_by_wheel_only_with_ctrl(self):
        with browser.report(self.driver, self.short):
            whole, plot = self.window(), self.plot()
            wheel = (
                "arguments[0].dispatchEvent(new WheelEvent('wheel', {"
                "deltaY: -200, ctrlKey: arguments[1], bubbles: true,"
                "cancelable: true, clientX: 600, clientY: 400}))"
            )
            self.driver.execute_script(wheel, plot, False)
            self.assertEqual(self.window(), whole)
            self.driver.execute_script(wheel, plot, True)
            self.assertLess(self.window()[1] - self.window()[0], whole[1] - whole[0])

    def test_buttons_and_keys(self):
        with browser.report(self.driver, self.short):
            whole = self.window()
            self.driver.find_element(By.ID, "zoom-in").click()
            half = self.window()
            self.assertAlmostEqual(half[1] - half[0], 0.5 * (whole[1] - whole[0]), places=6)
            self.driver.find_element(By.ID, "pan-right").click()
            self.assertGreater(self.window()[0], half[0])
            self.driver.execute_script("document.getElementById('time-plots').focus()")
            ActionChains(self.driver).send_keys(Keys.ARROW_LEFT, "-", "+", "+").perform()
            self.assertLess(self.window()[1] - self.window()[0], half[1] - half[0])
            ActionChains(self.driver).send_keys(Keys.HOME).perform()
            self.assertEqual(self.window(), whole)

    def test_the_cursor_reads_all_strips(self):
        with browser.report(self.driver, self.short):
            ActionChains(self.driver).move_to_element(self.plot()).perform()
            for track in ("torque", "model_torque", "residual", "position"):
                text = self.driver.find_element(By.CSS_SELECTOR, f"[data-track={track}]").text
                self.assertRegex(text, r"^-?[\d.]+", track)

    def test_switches_show_more_tracks(self):
        with browser.report(self.driver, self.short):
            self.assertFalse(
                self.driver.find_elements(By.CSS_SELECTOR, "[data-track=recorded_torque]")
            )
            self.driver.find_element(By.ID, "show-recorded_torque").click()
            self.assertTrue(
                self.driver.find_elements(By.CSS_SELECTOR, "[data-track=recorded_torque]")
            )
            self.assertEqual(browser.complaints(self.driver), [])

    def test_a_large_story_opens_fast(self):
        story = synthetic.story(rows=2 * ROWS, step=STEP, bucket=2)
        story["captures"].append(dict(story["captures"][0], file="again.csv"))
        with browser.report(self.driver, story) as file:
            drawn = self.driver.execute_script(
                "return performance.getEntriesByName('servoid-time-drawn')[0].startTime"
            )
            print(
                f"figure: {file.stat().st_size / 1e6:.1f} MB with 10 tracks of {ROWS} buckets: "
                f"drawn after {drawn:.0f} ms"
            )
            self.assertLess(drawn, 3000)
            zoom = self.driver.execute_script(
                "const t = performance.now(); document.getElementById('zoom-in').click();"
                "return performance.now() - t"
            )
            print(f"figure: a zoom takes {zoom:.0f} ms")


if __name__ == "__main__":
    unittest.main(verbosity=1)
