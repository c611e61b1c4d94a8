"""The story of a drive in the studio, for whichever drive: a mystery, a measured one."""

import pathlib
import shutil
import tempfile

import browser
import program
import user

HOSTILE = "<img src=x onerror=\"window.owned=1\">'&amp;.csv"


class Story:
    """Mixed into a TestCase that sets `model`, `capture` and `effect`, the one that is found."""

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())
        self.driver = self.enterContext(browser.chromium())

    def open(self, *options):
        url = self.enterContext(program.studio(self.model, self.capture, *options))
        return user.User(self.driver, url)

    def same(self, a, b):
        self.assertAlmostEqual(a / b, 1, delta=5e-4)

    def test_the_worst_place_add_undo_redo(self):
        told = program.answer("diagnose", self.model, self.capture)
        u = self.open()
        u.until_diagnosed()
        self.assertEqual(u.verdict(), told["verdict"])
        self.assertIn(self.effect.replace("_", " "), u.text("sentence").lower())
        self.same(u.error(), told["error_before"])
        first = u.all(".candidate")[0]
        self.assertEqual(first.get_attribute("data-effect"), self.effect)

        worst = u.by_id("worst-1")
        place = [float(worst.get_attribute(k)) for k in ("data-from", "data-to")]
        whole = u.window()
        u.press("worst-1")
        near = u.window()
        self.assertLess(near[1] - near[0], 0.3 * (whole[1] - whole[0]))
        self.assertLess(near[0], place[0])
        self.assertGreater(near[1], place[1])

        before = u.error()
        u.press("add-" + self.effect)
        browser.wait(lambda: self.effect in u.terms(), "the effect in the model", 30)
        browser.wait(lambda: u.error() != before, "another error", 30)
        u.quiet()
        better = self.folder + "/better.toml"
        program.run("add", self.effect, self.model, self.capture, "--out", better)
        after = u.error()
        self.same(after, program.answer("diagnose", better, self.capture)["error_before"])
        self.assertLess(after, 0.5 * before)
        self.assertEqual(u.window(), near, "the window stays over a new story")

        u.press("do-undo")
        browser.wait(lambda: u.error() == before, "the error as it was", 30)
        self.assertNotIn(self.effect, u.terms())
        u.press("do-redo")
        browser.wait(lambda: u.error() == after, "the error with it", 30)
        print(f"figure: {type(self).__name__}, + {self.effect}: {before:.3%} to {u.error():.3%}")

    def test_adding_says_what_add_says(self):
        u = self.open("--no-diagnose")
        u.by_id("effect-choice").send_keys(self.effect)
        u.press("effect-add")
        browser.wait(lambda: self.effect in u.terms(), "the effect in the model", 30)
        u.quiet()
        said = program.answer("add", self.effect, self.model, self.capture)
        self.same(u.error(), said["error_after"])
        for name, number in said["model_parameters"].items():
            self.same(u.value(name), number["value"])
        saved = u.save("save-model", self.folder)
        self.same(program.answer("compare", saved, self.capture)["torque_error"], u.error())

    def test_a_law_of_ones_own(self):
        u = self.open("--no-diagnose")
        before = u.error()
        u.open_law()
        u.type("law-name", "cubic")
        u.type("law-text", "k*v^3")
        browser.wait(lambda: "custom.cubic" in u.terms(), "the law", 30)
        browser.wait(lambda: u.error() < before, "a smaller error", 30)
        said = program.answer("add", "custom.cubic=k*v^3", self.model, self.capture)
        self.same(u.error(), said["error_after"])

    def test_a_wrong_law_is_refused_and_changes_nothing(self):
        u = self.open("--no-diagnose")
        before, terms = u.error(), u.terms()
        u.open_law()
        u.type("law-name", "wrong")
        u.type("law-text", "k*sin(theta")
        browser.wait(lambda: u.text("error"), "the refusal", 30)
        self.assertEqual(u.by_id("error").get_attribute("role"), "alert")
        self.assertIn("missing parenthesis", u.text("error"))
        self.assertEqual((u.error(), u.terms()), (before, terms))

    def test_numbers_are_edited_fixed_and_fitted(self):
        u = self.open("--no-diagnose")
        given, drawn = u.value("inertia"), u.picture("residual")
        u.type("value-inertia", repr(1.5 * given))
        browser.wait(lambda: u.value("inertia") == 1.5 * given, "the number", 30)
        heavier = self.folder + "/heavier.toml"
        text = u.save("save-model", self.folder).read_text()
        pathlib.Path(heavier).write_text(text)
        said = program.answer("compare", heavier, self.capture)
        browser.wait(lambda: abs(u.error() / said["torque_error"] - 1) < 5e-4, "its error", 30)
        self.assertNotEqual(u.picture("residual"), drawn)

        u.press("fixed-inertia")
        browser.wait(lambda: "fixed" in u.text("history"), "that it is fixed", 30)
        u.press("do-fit")
        browser.wait(lambda: "fit" in u.text("do-undo"), "the fit", 30)
        u.quiet()
        self.assertAlmostEqual(u.value("inertia"), 1.5 * given)
        u.press("fixed-inertia")
        browser.wait(lambda: "free" in u.text("do-undo"), "that it is free", 30)
        u.press("do-fit")
        browser.wait(lambda: u.value("inertia") < 1.4 * given, "a fitted number", 30)

    def test_a_term_off_and_on(self):
        u = self.open("--no-diagnose")
        u.press("do-fit")
        browser.wait(lambda: "fit" in u.text("do-undo"), "the fit", 30)
        u.quiet()
        fitted, name, last = u.error(), u.terms()[-1], len(u.terms()) - 1
        u.press(f"term-on-{last}")
        browser.wait(lambda: name + " (off)" in u.terms(), "the term is off", 30)
        browser.wait(lambda: u.error() > fitted, "a larger error", 30)
        u.press(f"term-on-{last}")
        browser.wait(lambda: name in u.terms(), "the term is on", 30)
        browser.wait(lambda: abs(u.error() / fitted - 1) < 1e-4, "the error as it was", 30)

    def test_refining_is_stopped_and_done(self):
        u = self.open("--no-diagnose")
        before = u.error()
        u.press("do-refine")
        browser.wait(lambda: "refine: " in u.text("busy"), "what is being done", 30)
        u.press("do-stop")
        browser.wait(lambda: not u.busy(), "that it stops", 5)
        self.assertEqual(u.error(), before)
        self.assertFalse(u.all("#ladder"))

        u.press("do-refine")
        shares = set()

        def refined():
            shares.update(b.get_attribute("value") for b in u.all("#busy-bar"))
            return u.all("#ladder")

        browser.wait(refined, "the ladder", 120)
        self.assertGreater(len(shares), 3, "a bar that moves")
        u.quiet()
        self.assertIn(self.effect, u.text("ladder"))
        said = program.answer("refine", self.model, self.capture)
        end = u.all(".ladder-table tr[data-step] [data-figure=fitted]")[-1]
        self.same(float(end.get_attribute("data-value")), said["ladder"][-1]["torque_error"])
        self.same(u.error(), said["ladder"][-1]["torque_error"])
        self.assertIsNone(u.number("error-after"), "it is the refined model that is shown")
        self.assertNotIn("together", u.text("sentence"))

    def test_a_report_and_a_reload_say_the_same(self):
        u = self.open()
        u.until_diagnosed()
        u.press("add-" + self.effect)
        browser.wait(lambda: self.effect in u.terms(), "the effect in the model", 30)
        u.quiet()
        error, verdict, sentence = u.error(), u.verdict(), u.text("sentence")
        report = u.save("save-report", self.folder)
        terms = u.terms()
        self.driver.refresh()
        browser.wait(lambda: u.all("#title") and u.terms(), "the page again")
        self.assertEqual(
            (u.error(), u.verdict(), u.terms()), (error, verdict, terms), "after a reload"
        )
        self.driver.get(report.as_uri())
        browser.settle(self.driver)
        self.assertEqual((u.verdict(), u.text("sentence")), (verdict, sentence))
        self.assertEqual(u.error(), error)
        self.assertEqual(browser.complaints(self.driver), [])

    def test_two_tabs_agree(self):
        u = self.open("--no-diagnose")
        before, first = u.error(), self.driver.current_window_handle
        u.run("window.notReloaded = true")
        self.driver.switch_to.new_window("tab")
        other = user.User(self.driver, u.url)
        other.type("value-inertia", repr(2 * u.value("inertia")))
        browser.wait(lambda: other.error() != before, "another error", 30)
        after = other.error()
        self.driver.switch_to.window(first)
        browser.wait(lambda: u.error() == after, "the other tab's news", 10)
        self.assertTrue(u.run("return window.notReloaded"))

    def test_captures_come_in_and_bad_ones_do_not(self):
        u = self.open("--no-diagnose")
        bad = pathlib.Path(self.folder) / "bad.csv"
        bad.write_text("time_s,torque_Nm\n0,1\n1,2\n")
        u.by_id("capture-file").send_keys(str(bad))
        browser.wait(lambda: u.text("error"), "the refusal", 30)
        self.assertIn("bad.csv", u.text("error"))
        self.assertIn("position", u.text("error"))
        self.assertEqual(len(u.all("#captures li")), 1)

        second = pathlib.Path(self.folder) / HOSTILE
        shutil.copyfile(self.capture, second)
        u.by_id("capture-file").send_keys(str(second))
        browser.wait(lambda: len(u.all("#captures li")) == 2, "the second capture", 30)
        browser.wait(lambda: u.all("#capture-tab-1"), "its plots", 30)
        self.assertEqual(u.all("#captures li")[1].get_attribute("data-file"), HOSTILE)
        self.assertEqual(u.text("capture-tab-1"), HOSTILE)
        self.assertIn(HOSTILE, u.text("files"))
        self.assertFalse(u.run("return window.owned"))
        self.assertEqual(u.all("img"), [])
        u.press("capture-on-1")
        browser.wait(lambda: not u.all("#capture-tab-1"), "one capture again", 30)


