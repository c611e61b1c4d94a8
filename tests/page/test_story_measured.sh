#!/usr/bin/env bash
# The same with the measured axis EMPS.
. "$(dirname "$0")/support.sh"
in_browser story_measured_in_browser.py
