#!/usr/bin/env bash
# A reset (NMT), a stop or bus off in the middle of a run. The answer is right or there is none, with
# the exit code and the words for it; what was heard before is kept, and the axis comes to rest.
. "$(dirname "$0")/broken.sh"

broken "reset" 300 "cansend vcan1 000#8101" 5 "node 1 was reset during the run" --free "${sines[@]}"
value_is drive.json resets 1
broken "reset of all nodes" 300 "cansend vcan1 000#8200" 5 "was reset during the run" "" "${moving[@]}"
[ "$(grep -c '^[0-9]' broken.csv)" -gt 500 ] || fail "the capture before the reset is lost"
broken "stop of the node" 300 "cansend vcan1 000#0201" 5 "aborted by user" --free "${moving[@]}"

off="cansend vcan0 20000040#0000000000000000"
broken "bus off" 300 "$off" 0 ".link.bus_off == 1" --free "${sines[@]}"
expect "bus off: another inertia" same_inertia good.json broken.json
broken "bus off" 300 "$off" 0 ".link.bus_off == 1 and .bus.bus_off == 1" --free "${moving[@]}"
heard_references broken.log system1
