#!/bin/sh
# Counts the instructions of one interrupt step under callgrind, over phases of the session and hard inputs.
# Fails unless all counts are equal.   step_cost.sh SOURCE_DIR WORK_DIR [CC]
set -eu
source_dir=$1
work=$2
cc=${3:-${CC:-cc}}
mkdir -p "$work"
"$cc" -std=c99 -O2 -I"$source_dir/include" ${SID_STEP_COST_FLAGS:-} "$source_dir/tests/core/step_cost.c" \
    "$source_dir"/src/*.c -o "$work/step_cost"
"$work/step_cost" 0
: >"$work/counts"
# 756 cases in all; every 7th meets each phase, torque and position.
case=0
while [ "$case" -lt 756 ]; do
    valgrind --tool=callgrind --callgrind-out-file="$work/out" --toggle-collect=counted \
        "$work/step_cost" "$case" >/dev/null 2>"$work/log"
    sed -n 's/^.*Collected : \([0-9]*\).*$/\1/p' "$work/log" >>"$work/counts"
    case=$((case + ${SID_STEP_COST_STRIDE:-19}))
done
sort -n "$work/counts" | uniq -c | sed 's/^ *\([0-9]*\) \([0-9]*\)$/interrupt step: \2 instructions in \1 cases/'
[ "$(wc -l <"$work/counts")" -gt 30 ] || { echo "too few counts" >&2; exit 1; }
[ "$(sort -u "$work/counts" | wc -l)" -eq 1 ] || { echo "min != max: not constant-time" >&2; exit 1; }
