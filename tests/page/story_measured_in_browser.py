#!/usr/bin/env python3
"""The measured axis EMPS in the studio, as a user takes it. See test_story_measured.sh."""

import os
import sys
import unittest

import drive
import program


class Emps(drive.Story, unittest.TestCase):
    model = program.EXAMPLES / "emps.toml"
    capture = program.DATA / "emps/emps_train.csv"
    effect = "coulomb"


# What takes half a minute more is done with the mystery, and here with SERVOID_PAGE_LONG set.
THE_STORY = ["the_worst_place_add_undo_redo", "a_law_of_ones_own", "refining_is_stopped_and_done",
             "a_report_and_a_reload_say_the_same"]

if __name__ == "__main__":
    if not Emps.capture.exists():
        sys.exit("skipped: no data")
    whole = "SERVOID_PAGE_LONG" in os.environ
    unittest.main(verbosity=1, defaultTest=None if whole else [f"Emps.test_{name}" for name in THE_STORY])
