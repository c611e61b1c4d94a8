#!/usr/bin/env bash
# No bus, or not the one that was meant: exit 5, and what to do. A drive that does not talk: what was
# expected and what was heard.
. "$(dirname "$0")/support.sh"
make_logs

refused() { # TEXT OPTIONS...
    local text=$1 status=0
    shift
    "$servoid" replay --map counter.toml --json "$@" >out 2>err || status=$?
    [ $status -eq 5 ] || fail "$*: exit $status, 5 was expected: $(cat err)"
    [ ! -s out ] || fail "$*: an answer"
    said err "$text"
}

refused "can7: there is no such interface; there are vcan0, vcan1; \`ip link add dev" --can can7
refused "a_name_too_long_for_the_kernel: there is no such" --can a_name_too_long_for_the_kernel
refused "lo: no CAN interface; there are vcan0" --can lo
ip link set vcan1 down
refused "vcan1: the interface is down: \`ip link set vcan1 up type can bitrate 500000\`" --can vcan1

listen silent --map counter.toml --wait 0.5
ended silent 5
said silent.err "no frame 0x181; heard: nothing"
listen others --map counter.toml --wait 0.8
for id in 201 181 ; do cansend vcan0 00000$id#11; done # 29 bits: others
cansend vcan0 080#
ended others 5
said others.err "no frame 0x181; heard: 0x080, 0x00000181x, 0x00000201x"
listen synced --profile cia402 --idle 0.3
canplayer -I counter.log vcan0=can0
ended synced 5
said synced.err "no frame 0x080; heard: 0x181"
listen waiting --map counter.toml --wait 60
kill -INT "$listener"
ended waiting 5

# User-mode Linux can be rid of CAN altogether; a kernel that others use cannot.
if grep -q "User Mode Linux" /proc/cpuinfo; then
    rmmod vcan can_raw can
    refused "vcan0: this kernel has no CAN: \`modprobe can_raw\`" --can vcan0
fi
