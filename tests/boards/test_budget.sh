#!/usr/bin/env bash
# Instructions, stack, flash and RAM on every board: within their limits, and what boards/README.md
# says. The stack by the call graph holds for every path, the counted one for those that ran.
. "$(dirname "$0")/support.sh"
status=0
"$root/tools/budget" --same >budget.txt || status=$?
[ "$status" -eq 0 ] || fail "$(cat budget.txt)"
grep -q '^70 limits, 0 exceeded' budget.txt || fail "not all limits were looked at: $(tail -n 1 budget.txt)"
sed -nE 's/^((board|bytes|stack of|sid_identify_step|in a session|of the interrupt|flash|RAM of a session|sid_bin and|all modules) .*|sid_identify_step .*|[0-9]+ limits.*)$/figure: budget: \1/p' budget.txt |
    tr -s ' '
