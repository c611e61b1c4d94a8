#!/usr/bin/env bash
# Others on the bus: a second master that behaves, one that does not, and one that fills the bus.
. "$(dirname "$0")/drive.sh"

drive system1 vcan0 --free
command_ good --free "${sines[@]}"
drive_ends

# In real time, for a status query is told apart from a master by it.
bad_cable --at 200 "touch running"
drive system1 vcan1
"$servoid" command --can vcan0 --json move "$the_move",cycles=6 --log first.log >first.json 2>first.err &
first=$!
for ((tries = 0; tries < 500; tries++)); do [ ! -e running ] || break; sleep 0.01; done
command_ second identify --amplitude 0.5
[ $status -eq 5 ] || fail "a second master: exit $status"
said second.err "node 1 belongs to another master, or runs"
wait $first || fail "the first master: $(cat first.err)"
[ "$(jq '.link.foreign_requests > 10 and .link.foreign_changes == 0' first.json)" = true ] ||
    fail "the first master does not say that there was another: $(jq -c .link first.json)"
drive_ends && cable_ends
the_move=$the_move,cycles=6 heard_references first.log system1
rm system1.ref.csv
figure_of "second master" move "first: foreign_requests $(jq .link.foreign_requests first.json), $rows; second: exit 5, $(cut -c10-60 second.err)"

# meddled NAME FRAME EXIT TEXT HOW WHAT...: somebody sends this frame in the middle of the run.
meddled() {
    bad_cable --at 200 "cansend vcan0 $2"
    drive system1 vcan1 $5
    command_ meddled $5 "${@:6}"
    [ $status -eq "$3" ] || fail "$1: exit $status: $(cat meddled.err)"
    if [ $status -eq 5 ]; then
        said meddled.err "$4"
        said meddled.err "another master talks to this node: 1 frames"
    else
        [ "$(jq "$4" meddled.json)" = true ] || fail "$1: $(jq -c .link meddled.json)"
        [ "$6" != identify ] || expect "$1: another inertia" same_inertia good.json meddled.json
    fi
    drive_ends && cable_ends
    figure_of "$1 by a stranger" "$6" "exit $status; $(cut -c10- meddled.err | tail -n 1)$(
        jq -c '.link | {foreign_requests, foreign_changes}' meddled.json 2>/dev/null)"
}
moving=(move "$the_move" --log meddled.log)
heeded=".link.foreign_requests == 1 and .link.foreign_changes == 0"
meddled abort 601#2F012A0501000000 5 "aborted by user" --free "${moving[@]}"
meddled abort 601#2F012A0501000000 5 "aborted by user" --free "${sines[@]}"
meddled start 601#23012A0407000000 0 "$heeded" --free "${sines[@]}"
meddled "a claim" 601#23012A0107000000 0 "$heeded" --free "${moving[@]}"
meddled "release of the claim" 601#23012A0100000000 0 "$heeded" --free "${sines[@]}"
meddled "another plan" 601#23062A0100010000 0 "$heeded" --free "${sines[@]}"
meddled "another move" 601#23012A0300010000 0 "$heeded" --free "${moving[@]}"
heard_references meddled.log system1
meddled "a frame of references" 501##1010E000000000000"$(printf '0%.0s' {1..112})" 5 "another master has changed" --free "${moving[@]}"
