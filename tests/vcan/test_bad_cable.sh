#!/usr/bin/env bash
# A cable that loses, repeats, reorders, delays or cuts frames between the master and its drive. A
# session gives the inertia of a good cable, a move the references that were asked for; what struck is
# counted where the user looks; the axis comes to rest.
. "$(dirname "$0")/drive.sh"

# counted FILE FILTER: this number of the answer is not 0.
counted() {
    [ "$(jq "($2) > 0" "$1")" = true ] || fail "$1: $2 is 0: $(jq -c '.bus, .link' "$1")"
}

session() { # FAULT MODEL WHERE HOW...
    local fault=$1 model=$2 where=$3
    bad_cable --seed 3 "${@:5}"
    drive "$model" vcan1 $4
    command_ session $4 "${sines[@]}"
    [ $status -eq 0 ] || fail "$fault: exit $status: $(cat session.err)"
    drive_ends
    cable_ends
    expect "$fault: another inertia: $(inertias session.json)" same_inertia "$model.good.json" session.json
    counted session.json "$where"
    figure_of "$fault" "identify, $model" "$where $(jq "$where" session.json); J $(inertias session.json |
        cut -d' ' -f1 | tr '\n' ' ')as on a good cable"
}

move() { # FAULT MODEL WHERE HOW...
    local fault=$1 model=$2 where=$3
    bad_cable --seed 4 "${@:5}"
    drive "$model" vcan1 $4
    command_ move $4 move $the_move --log heard.log
    [ $status -eq 0 ] || fail "$fault: exit $status: $(cat move.err)"
    drive_ends
    cable_ends
    heard_references heard.log "$model"
    counted move.json "$where"
    figure_of "$fault" "move, $model" "$where $(jq "$where" move.json); $rows"
}

for model in system1 system2; do
    drive $model vcan0 --free
    command_ $model.good --free "${sines[@]}"
    [ $status -eq 0 ] || fail "a good cable: exit $status: $(cat $model.good.err)"
    drive_ends
done
session "1 % lost" system1 ".bus.lost" --free --lose 1
session "5 % repeated" system1 ".bus.repeated" --free --repeat 5
session "5 % overtaken" system1 ".bus.reordered" --free --reorder 5
session "1 % cut short" system1 ".bus.short" --free --cut 1
session "everything at once" system2 ".bus.lost" --free --lose 1 --repeat 2 --reorder 2 --cut 1
move "1 % lost" system1 ".bus.lost" --free --lose 1
move "5 % repeated" system2 ".bus.repeated" --free --repeat 5
move "5 % overtaken" system1 ".bus.reordered" --free --reorder 5
move "1 % cut short" system2 ".bus.short" --free --cut 1

# In real time: what must not come too late, comes late.
session "late by up to 20 ms" system1 ".link.requests" "" --delay 20
move "late by up to 50 ms" system2 ".link.requests" "" --delay 50
move "1 % lost, in real time" system1 ".link.references_refused" "" --lose 1
