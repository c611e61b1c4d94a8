#!/usr/bin/env python3
"""Ten minutes at 8 kHz on one page. See test_long.sh."""

import os
import pathlib
import resource
import tempfile
import time
import unittest
import urllib.request

import browser
import program

MODEL = program.EXAMPLES / "system1.toml"
PEAK, PEAK_ROW = 0.6, 0.37  # N·m; where, as a share of the rows
WHOLE, PART = 2000, 50  # cycles: 4,819,200 and 120,480 rows

# Milliseconds from the navigation until the plots over time stood.
DRAWN = "return performance.getEntriesByName('servoid-time-drawn')[0]?.startTime"

# Of what is drawn of the recorded torque in a window: the most, and when.
MOST = """
const mode = JSON.parse(document.getElementById('servoid-mode').textContent);
const capture = mode.story.captures[0];
const track = Series.decode(capture.series.recorded_torque);
const to = arguments[0] || capture.duration_s;
return Series.rows([track], 0, to, 1000).reduce((a, b) => b[1] > a[1] ? b : a)
    .concat(capture.duration_s, capture.rows);"""


def with_peak(source, out):
    """The same capture, one sample of its torque replaced."""
    with open(source) as lines:
        rows = sum(not line.startswith("#") for line in lines) - 1
    place, row = None, -1
    with open(source) as lines, open(out, "w") as copy:
        for line in lines:
            if place is None and not line.startswith("#"):
                place = line.strip().split(",").index("torque_ref_Nm")
            elif place is not None:
                row += 1
            if place is not None and row == int(PEAK_ROW * rows):
                words = line.strip().split(",")
                words[place] = str(PEAK)
                line = ",".join(words) + "\n"
            copy.write(line)


class TenMinutes(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def capture(self, cycles):
        move = f"trapezoid:stroke=6.28,velocity=50,cycles={cycles},torque_noise=1e-3"
        plain, peaked = self.folder / "plain.csv", self.folder / "long.csv"
        program.run("simulate", MODEL, "--experiment", move, "--seed", 7, "--out", plain)
        with_peak(plain, peaked)
        plain.unlink()
        return peaked

    def diagnosed(self, cycles, name):
        """The report by the verb: every effect is fitted."""
        capture, out = self.capture(cycles), self.folder / "long.html"
        start = time.monotonic()
        program.run("report", MODEL, capture, "--no-refine", "--out", out, timeout=3600)
        took = time.monotonic() - start
        memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e6
        print(f"figure: report with diagnosis, {name} = {took:.0f} s, {memory:.2f} GB")
        return out

    def not_diagnosed(self, cycles, name):
        """The same page, as the studio saves it before anything was diagnosed."""
        capture, out = self.capture(cycles), self.folder / "long.html"
        start = time.monotonic()
        with program.studio(MODEL, capture, "--no-diagnose") as url:
            with urllib.request.urlopen(url + "api/report.html") as page:
                out.write_bytes(page.read())
        took = time.monotonic() - start
        print(f"figure: report without diagnosis, {name} = {took:.0f} s")
        return out

    def opens(self, file, name):
        size = file.stat().st_size / 1e6
        with browser.chromium() as driver:
            browser.look(driver, 1280)
            driver.get(file.as_uri())
            browser.wait(lambda: driver.execute_script(DRAWN), "the plots")
            browser.settle(driver)
            seconds = driver.execute_script(DRAWN) / 1e3
            at, most, duration, rows = driver.execute_script(MOST, None)
            near = driver.execute_script(MOST, 2 * PEAK_ROW * duration)
            self.assertEqual(browser.complaints(driver), [])
        print(f"figure: report of {rows} rows, {name}: {size:.2f} MB, drawn in {seconds:.2f} s")
        self.assertLess(size, 10)
        self.assertLess(seconds, 3)
        for when, torque in ((at, most), near[:2]):
            self.assertAlmostEqual(torque, PEAK, delta=1e-3)
            self.assertAlmostEqual(when, PEAK_ROW * duration, delta=2e-3 * duration)

    def test_a_fortieth_is_diagnosed(self):
        name = "a fortieth"
        self.opens(self.diagnosed(PART, name), name)

    def test_the_whole_is_drawn(self):
        name = "4.8 million rows"
        self.opens(self.not_diagnosed(WHOLE, name), name)

    @unittest.skipUnless("SERVOID_PAGE_LONG" in os.environ, "minutes: with SERVOID_PAGE_LONG")
    def test_the_whole_is_diagnosed(self):
        name = "4.8 million rows, diagnosed"
        self.opens(self.diagnosed(WHOLE, name), name)


if __name__ == "__main__":
    unittest.main(verbosity=1)
