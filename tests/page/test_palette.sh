#!/usr/bin/env bash
# Text and lines stand out from what is behind them as WCAG AA asks, in both themes.
. "$(dirname "$0")/support.sh"
python3 "$here/palette_contrast.py"
