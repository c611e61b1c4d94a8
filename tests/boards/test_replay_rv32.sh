#!/usr/bin/env bash
# All sums and results of 13 sessions and of each module at its limits are the PC's to the bit on a 32-bit RISC-V.
. "$(dirname "$0")/replay.sh"
for level in -O0 -O2 -O3 -Os; do replays rv32_virt "$level"; done
