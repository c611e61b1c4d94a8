#!/usr/bin/env bash
# What fails in a drive's hardware ends a session with its reason and the reference at rest, executed
# on a Cortex-M4; missed interrupts are really missed.
. "$(dirname "$0")/support.sh"
build mps2_an386 faults "$here/faults.c" "$root"/boards/drive/{drive,plant}.c
run mps2_an386 faults
cat faults.txt
echo "figure: faults: $(wc -l <faults.txt) runs on a Cortex-M4 end with the reason of their fault and the reference at rest"
