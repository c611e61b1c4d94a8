#!/usr/bin/env bash
# All sums and results of 13 sessions and of each module at its limits are the PC's to the bit on a Cortex-M33 and an M55.
. "$(dirname "$0")/replay.sh"
for board in mps2_an505 mps3_an547; do
    for level in -O0 -O2 -O3 -Os; do replays "$board" "$level"; done
done
