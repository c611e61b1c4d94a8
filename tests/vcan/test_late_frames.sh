#!/usr/bin/env bash
# In real time, what must not come too late comes late, by up to a twentieth of a second each way, or
# must be sent again.
. "$(dirname "$0")/cable.sh"

good_cable system1
session "late by up to 20 ms" system1 ".link.requests" "" --delay 20
move "late by up to 50 ms" system2 ".link.requests" "" --delay 50
move "1 % lost, in real time" system1 ".link.references_refused" "" --lose 1
