#!/usr/bin/env bash
# The report in a browser: hostile text, axes, layout, the keyboard, what is missing in a story.
. "$(dirname "$0")/support.sh"
in_browser report_in_browser.py
