#!/usr/bin/env bash
# The master dies in the middle of a run: the drive holds its axis within three control periods after
# the time that it waits for a heartbeat, and the next master can have it. A drive that dies: the
# master says so, and keeps what it heard.
. "$(dirname "$0")/drive.sh"

# Telemetry frames after which the master is killed; the time it promised its heartbeat in.
master_dies() { # AFTER MS HOW WHAT...
    local after=$1 ms=$2 how=$3 periods master
    rm -f master
    bad_cable --at "$after" 'kill -KILL $(cat master)'
    drive system1 vcan1 $how
    "$servoid" command --can vcan0 --timeout "$ms" $how "${@:4}" >dead.json 2>dead.err &
    master=$!
    echo $master >master
    status=0
    wait $master 2>/dev/null || status=$?
    [ $status -eq 137 ] || fail "the master was not killed: exit $status, $(cat dead.err)"
    if [ -n "$how" ]; then # its time passes with SYNC: another one's, who wants nothing of the node
        cangen vcan0 -I 080 -L 0 -g 1 -n $((ms / 5 + 8))
    else
        sleep "$(awk "BEGIN { print $ms / 1000 + 0.3 }")"
    fi
    command_ status status
    value_is status.json state aborted
    value_is status.json reason "master lost"
    value_is status.json claimed false
    drive_ends
    value_is drive.json reason "master lost"
    cable_ends
    periods=$(value drive.json held_periods_after_heartbeat)
    holds "$periods >= 8 * $ms && $periods <= 8 * $ms + 3" ||
        fail "held $periods periods after the last heartbeat, for $((8 * ms))"
    figure_of "master killed after $after frames of telemetry" "${4}${how:+, free-running}" \
        "drive: master lost; held $periods periods after the last heartbeat, $((8 * ms)) allowed"
}

long=(move trapezoid:stroke=6.28,velocity=40,cycles=40)
master_dies 20 100 "" "${long[@]}"
master_dies 500 250 "" "${long[@]}"
master_dies 300 500 --free identify --amplitude 0.5 --frequency 50 20 10 --windows 4
master_dies 1100 20 --free identify --amplitude 0.5 --frequency 50 20 10 --windows 4

# The drive dies: exit 5 within the time of a few requests, and the capture so far is kept.
drive_dies() { # HOW
    bad_cable --at 600 'kill -KILL $(cat drive)'
    drive system1 vcan1 $1
    echo "$drive" >drive
    command_ orphan $1 "${long[@]}" --out orphan.csv
    [ $status -eq 5 ] || fail "the drive is dead: exit $status"
    said orphan.err "node 1 does not answer"
    rows=$(grep -c '^[0-9]' orphan.csv)
    ((rows > 1000)) || fail "of the capture $rows rows are left"
    wait "$drive" 2>/dev/null || true
    cable_ends
    figure_of "drive killed" "move${1:+, free-running}" "exit 5, $(cut -c10- orphan.err | tail -n 1); $rows rows kept"
}
drive_dies ""
drive_dies --free
