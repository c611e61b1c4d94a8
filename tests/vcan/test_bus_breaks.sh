#!/usr/bin/env bash
# The bus or the drive breaks in the middle of a run: a reset (NMT), bus off, an interface that is
# down for a while, or for good. The answer is right or there is none, with the exit code and the
# words for it; what was heard before is kept, and the axis comes to rest.
. "$(dirname "$0")/drive.sh"

drive system1 vcan0 --free
command_ good --free "${sines[@]}"
drive_ends

# broken FAULT AT COMMAND EXIT TEXT HOW WHAT...: TEXT is what the master says on stderr, or a filter
# that its answer must fulfil.
broken() {
    local fault=$1 expected=$4 text=$5 how=$6
    bad_cable --at "$2" "$3"
    drive system1 vcan1 $how
    command_ broken $how "${@:7}"
    [ $status -eq "$expected" ] || fail "$fault: exit $status, $expected was expected: $(cat broken.err)"
    if [ $status -eq 5 ]; then
        said broken.err "$text"
        text="exit 5, $(cut -c10- broken.err | tail -n 1)"
    else
        [ "$(jq "$text" broken.json)" = true ] || fail "$fault: $text: $(jq -c .bus,.link broken.json)"
    fi
    drive_ends "${drive_exit:-0}"
    cable_ends
    figure_of "$fault" "${7}${how:+, free-running}" "$text; drive: $(value drive.json state), $(value drive.json reason)"
}
moving=(move "$the_move" --out broken.csv --log broken.log)

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
