#!/usr/bin/env bash
# A node that a real interrupt steps while its bus is served: a session with telemetry of every
# sample, and a master that falls silent, on every board.
. "$(dirname "$0")/support.sh"
for board in "${boards[@]}"; do
    build "$board" "$board" "$here/node.c" "$root"/boards/drive/{drive,plant}.c
    run "$board" "$board"
    sed "s/^/$board: /" "$board.txt"
done
