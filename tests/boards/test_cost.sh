#!/usr/bin/env bash
# Instructions and stack of the interrupt, counted while it executes, at the corners of every sample
# in every phase: the same for all of them, and within the budget.
. "$(dirname "$0")/support.sh"

# cost BOARD STEP NODE SPREAD: most instructions; how far apart two counts may be.
cost() {
    build "$1" "$1" "$here"/cost*.c -- -O2 "-DCOST_MOST_STEP=$2U" "-DCOST_MOST_NODE=$3U" \
        "-DCOST_SPREAD=$4U" -DCOST_MOST_STACK=128U
    run "$1" "$1"
    sed "s/^/$1: /" "$1.txt"
}
cost mps2_an386 150 215 0
sed 's/^/figure: Cortex-M4: /' mps2_an386.txt
cost mps2_an500 156 221 0
cost mps2_an505 150 215 0
cost mps3_an547 156 221 0
# Without a conditional move the end of the ramp is a branch: one instruction.
cost rv32_virt 370 455 1
