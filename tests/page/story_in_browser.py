#!/usr/bin/env python3
"""A mystery drive in the studio, as a user takes it. See test_story.sh."""

import tempfile
import unittest

import drive
import program

MOVE = "trapezoid:stroke=6.28,velocity=50,cycles=8,torque_noise=1e-3"


class Mystery(drive.Story, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.model, cls.capture = program.EXAMPLES / "system1.toml", folder + "/mystery.csv"
        drawn = ("--mystery", 1, "--experiment", MOVE, "--out", cls.capture)
        program.run("simulate", cls.model, *drawn)
        cls.effect = program.answer("reveal", cls.capture)["effect"]


if __name__ == "__main__":
    unittest.main(verbosity=1)
