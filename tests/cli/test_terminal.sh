#!/usr/bin/env bash
# The program in a pseudo-terminal: no line is wider than it, colours where they belong, a ladder that
# grows, commands that can be pasted, progress that leaves nothing behind.
set -euo pipefail
export PYTHONDONTWRITEBYTECODE=1
here=$(realpath "${SERVOID_SOURCE_DIR:?path of the source}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 "$here/tests/cli/terminal.py" "$(realpath "${SERVOID_PROGRAM:?path of the built program}")" \
    "$here/examples" "$work"
