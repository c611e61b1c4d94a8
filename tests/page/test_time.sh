#!/usr/bin/env bash
# The plots over time: no peak is lost, gaps stay gaps, large stories open fast.
. "$(dirname "$0")/support.sh"
in_browser time_in_browser.py
