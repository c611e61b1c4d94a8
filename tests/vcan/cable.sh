# Sessions and moves over a bad cable, held against the same over a good one.
. "$(dirname "$0")/drive.sh"

# counted FILE FILTER: this number of the answer is not 0.
counted() {
    [ "$(jq "($2) > 0" "$1")" = true ] || fail "$1: $2 is 0: $(jq -c '.bus, .link' "$1")"
}

# session FAULT MODEL WHERE HOW FAULTS...: WHERE is the number of the answer that counts the fault.
session() {
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

move() { # as session
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

# What the sessions shall give.
good_cable() { # MODELS...
    local model
    for model; do
        drive $model vcan0 --free
        command_ $model.good --free "${sines[@]}"
        [ $status -eq 0 ] || fail "a good cable: exit $status: $(cat $model.good.err)"
        drive_ends
    done
}
