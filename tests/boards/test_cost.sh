#!/usr/bin/env bash
# Instructions and stack of the interrupt, counted while it executes, at the corners of every sample
# in every phase: the same for all of them, within the budget, and what boards/README.md says.
. "$(dirname "$0")/support.sh"

# The row of the table: step, node without a run, in a session, in a move, first sample; stacks.
row() { # BOARD
    printf '| `%s` |' "$1"
    sed -n 's/^sid.*: \([0-9]*\)\.\.\([0-9]*\) instr.*/\1 \2/p' "$1.txt" |
        awk '{ printf " %s |", $1 == $2 ? $1 : $1 "…" $2 }'
    sed -n 's/^sid_identify_step.* stack \([0-9]*\) .*/ \1 |/p; s/^interrupt: stack \([0-9]*\) .*/ \1 |/p' \
        "$1.txt" | tr -d '\n'
}

# cost BOARD STEP NODE SPREAD: most instructions; how far apart two counts may be.
cost() {
    build "$1" "$1" "$here"/cost*.c -- -O2 "-DCOST_MOST_STEP=$2U" "-DCOST_MOST_NODE=$3U" \
        "-DCOST_SPREAD=$4U" -DCOST_MOST_STACK=128U
    run "$1" "$1"
    echo "$(row "$1")"
    grep -qxF -- "$(row "$1")" "$root/boards/README.md" || fail "boards/README.md: not its row of $1"
}
cost mps2_an386 150 215 0
sed 's/^/figure: Cortex-M4, executed: /' mps2_an386.txt
cost mps2_an500 156 221 0
cost mps2_an505 150 215 0
cost mps3_an547 156 221 0
# Without a conditional move the end of the ramp is a branch: one instruction.
cost rv32_virt 370 455 1
