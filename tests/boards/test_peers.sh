#!/usr/bin/env bash
# What servoid and other methods cost on a Cortex-M4 for the same window, and their errors, are what
# boards/README.md says. CMSIS-DSP is not part of this repository: SERVOID_CMSIS_DSP names its
# sources, else its rows are left out.
. "$(dirname "$0")/support.sh"
"$root/boards/peers" ${SERVOID_CMSIS_DSP:+"$SERVOID_CMSIS_DSP"} >peers.txt
wanted=12 # lines that are not empty
if [ -n "${SERVOID_CMSIS_DSP-}" ]; then wanted=15; else echo "skipped: no CMSIS-DSP (SERVOID_CMSIS_DSP)"; fi
[ "$(grep -c . peers.txt)" -eq "$wanted" ] || fail "not the rows of all methods: $(cat peers.txt)"
while IFS= read -r line; do
    [ -z "$line" ] || grep -qxF -- "$line" "$root/boards/README.md" || fail "not in boards/README.md: $line"
done <peers.txt
sed -nE 's/^\| (.*) \|$/figure: peers on a Cortex-M4: \1/; /---/!p' peers.txt | grep '^figure'
