#!/usr/bin/env bash
# The studio in a browser, before a server that only keeps what it is told.
. "$(dirname "$0")/support.sh"
in_browser studio_in_browser.py
