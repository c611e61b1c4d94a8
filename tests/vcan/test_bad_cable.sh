#!/usr/bin/env bash
# A cable that loses, repeats, reorders or cuts frames between the master and its drive: a session
# gives the inertia of a good cable; what struck is counted where the user looks; the axis comes to
# rest.
. "$(dirname "$0")/cable.sh"

good_cable system1 system2
session "1 % lost" system1 ".bus.lost" --free --lose 1
session "5 % repeated" system1 ".bus.repeated" --free --repeat 5
session "5 % overtaken" system1 ".bus.reordered" --free --reorder 5
session "1 % cut short" system1 ".bus.short" --free --cut 1
session "everything at once" system2 ".bus.lost" --free --lose 1 --repeat 2 --reorder 2 --cut 1
