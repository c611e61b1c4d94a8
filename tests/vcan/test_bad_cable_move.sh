#!/usr/bin/env bash
# The same cable under a streamed move: in every row that was received stands the reference that was
# asked for.
. "$(dirname "$0")/cable.sh"

move "1 % lost" system1 ".bus.lost" --free --lose 1
move "5 % repeated" system2 ".bus.repeated" --free --repeat 5
move "5 % overtaken" system1 ".bus.reordered" --free --reorder 5
move "1 % cut short" system2 ".bus.short" --free --cut 1

