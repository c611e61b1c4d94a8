#!/usr/bin/env python3
"""The measured axis EMPS in the studio, as a user takes it. See test_story_measured.sh."""

import sys
import unittest

import drive
import program


class Emps(drive.Story, unittest.TestCase):
    model = program.EXAMPLES / "emps.toml"
    capture = program.DATA / "emps/emps_train.csv"
    effect = "coulomb"


if __name__ == "__main__":
    if not Emps.capture.exists():
        sys.exit("skipped: no data")
    unittest.main(verbosity=1)
