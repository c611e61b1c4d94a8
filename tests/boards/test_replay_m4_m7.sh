#!/usr/bin/env bash
# All sums and results of 13 sessions and of each module at its limits are the PC's to the bit on a Cortex-M4 and an M7: with
# the instructions written out in sid_bin.h, and without.
. "$(dirname "$0")/replay.sh"
for board in mps2_an386 mps2_an500; do
    for level in -O0 -O2 -O3 -Os; do
        replays "$board" "$level"
        [ "$level" = -O0 ] || [ "$(written_out)" -ge 3 ] || fail "$board $level: sums in plain C"
    done
    for level in -O2 -Os; do
        replays "$board" "$level" -DSID_NO_ASM
        [ "$(written_out)" -eq 0 ] || fail "$board $level -DSID_NO_ASM: sums not in plain C"
    done
done
echo "figure: replay: sums and results of $count builds for Cortex-M4 and M7 are the PC's to the bit"
