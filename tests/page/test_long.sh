#!/usr/bin/env bash
# Ten minutes at 8 kHz: the page is small, opens fast, and a peak of one sample is on it.
#
# What takes minutes, every effect fitted to 4.8 million rows, only with SERVOID_PAGE_LONG set. Else a
# fortieth of it is diagnosed, and the page of all rows is the one that the studio saves undiagnosed.
. "$(dirname "$0")/support.sh"
in_browser long_in_browser.py
