#!/usr/bin/env bash
# Random DBC files and frames, decoded by us and by other programs: canmatrix, which Debian has, and
# cantools where it is installed (SERVOID_PEER_PYTHON: a python that has it).
#
#   SERVOID_PROGRAM=... tests/peer/test_dbc.sh
set -euo pipefail
here=$(dirname "$0")
decoder=$(dirname "${SERVOID_PROGRAM:?path of the built program}")/servoid_decode_dbc
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

compared=0
for peer in canmatrix cantools; do
    for python in ${SERVOID_PEER_PYTHON:+"$SERVOID_PEER_PYTHON"} python3 /usr/bin/python3; do
        "$python" -c "import $peer" >/dev/null 2>&1 || continue
        for seed in 1 2 3; do
            "$python" -B "$here/compare_dbc.py" "$decoder" $peer $seed "$work"
        done
        compared=$((compared + 1))
        break
    done
done
((compared)) || { echo "no python3 here has canmatrix (Debian: python3-canmatrix)"; exit 1; }
