#!/usr/bin/env bash
# The real program with a mystery drive, in a browser: diagnosed, added, undone, edited, refined, saved.
. "$(dirname "$0")/support.sh"
in_browser story_in_browser.py
