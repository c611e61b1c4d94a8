#!/usr/bin/env bash
# An interface is down for a while, or for good, in the middle of a run. The answer is right or there
# is none, with the exit code and the words for it; the axis comes to rest.
. "$(dirname "$0")/broken.sh"

# Half the time that the drive waits for a heartbeat.
pause="(ip link set vcan0 down; sleep 0.1; ip link set vcan0 up)"
broken "master's interface down" 300 "$pause" 0 ".link.interface_down == 1" --free "${sines[@]}"
expect "interface down: another inertia" same_inertia good.json broken.json
broken "master's interface down" 300 "$pause" 0 ".link.interface_down == 1" --free "${moving[@]}"
heard_references broken.log system1
broken "drive's interface down" 300 "${pause//vcan0/vcan1} &" 0 ".bus.lost > 0" "" "${moving[@]}"
value_is drive.json interface_down 1
heard_references broken.log system1

# For good: each end says so, and the drive comes to rest without a bus.
broken "master's interface down for good" 300 "ip link set vcan0 down" 5 "vcan0: the interface is down" "" "${moving[@]}"
ip link set vcan0 up
drive_exit=5 broken "drive's interface gone" 300 "ip link set vcan1 down" 5 "node 1 does not answer" "" "${moving[@]}"
said drive.err "vcan1: the interface is down"
