#!/usr/bin/env bash
# tools/demo-story without measured data: from another folder, to its end, with an error that falls to
# the noise floor, and a mystery that diagnose names as reveal does.
set -euo pipefail
source_dir=$(realpath "${SERVOID_SOURCE_DIR:-$(dirname "$0")/../..}")
program=$(realpath "${SERVOID_PROGRAM:?path of the built program}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
ln -s "$program" program
SERVOID_DATA_DIR=none "$source_dir/tools/demo-story" ./program story >text
for line in '^No measured data|^== No measured data' '^  no friction ' '^  \+ viscous ' '^  \+ coulomb ' \
    '^  noise floor ' '^What remains, ' '^\$ servoid diagnose ' '^\$ servoid simulate .* --mystery ' \
    '^\$ servoid refine ' '^\$ servoid report ' '^\$ servoid reveal '; do
    grep -qE "$line" text || { echo "not in the demo's text: $line"; cat text; exit 1; }
done
grep -q '"verdict":"missing"' story/report.html || { echo "no report"; cat text; exit 1; }
hidden=$(sed -n '/^\$ servoid reveal /{n;s/ .*//p}' text)
[ -n "$hidden" ] && grep -qE "^add $hidden:" text || { echo "diagnose does not name $hidden"; cat text; exit 1; }
