# A simulated drive and its master on the buses, with or without a bad cable between them. For the
# scripts that need both; nothing here may wait without an end.
. "$(dirname "$0")/support.sh"
scripts=$(realpath "$(dirname "$0")")
cable=$(dirname "$servoid")/servoid_fault_bridge
trap 'kill -KILL $(jobs -p) 2>/dev/null || true; rm -rf "$work"' EXIT

# value FILE KEY: of the JSON, the first of that name.
value() { sed -n 's/^ *"'"$2"'": \(.*[^,]\),\{0,1\}$/\1/p' "$1" | head -n 1 | tr -d '"'; }
value_is() { # FILE KEY VALUE
    [ "$(value "$1" "$2")" = "$3" ] || fail "$1: $2 is $(value "$1" "$2"), $3 was expected"
}
holds() { awk "BEGIN { exit !($1) }" </dev/null; } # an expression of awk

wait_for() { # TEXT FILE
    local tries
    for ((tries = 0; tries < 200; tries++)); do
        ! grep -qF -- "$1" "$2" 2>/dev/null || return 0
        sleep 0.02
    done
    fail "$2 never said \"$1\": $(cat "$2")"
}

# drive MODEL INTERFACE OPTIONS...: into drive.json; its process in $drive.
drive() {
    : >drive.err
    "$servoid" drive "$examples/$1.toml" --can "$2" --for "${drive_for:-60}" --json "${@:3}" >drive.json 2>drive.err &
    drive=$!
    wait_for "node 1 on" drive.err
}

# The drive is switched off, or ends by itself with that exit code; whatever happened to it, its axis
# is at rest. One turn of 8 periods may see the encoder flicker by a count.
drive_ends() { # [EXIT CODE]
    local status=0 tries
    for ((tries = 0; ${1:-0} != 0 && tries < 100; tries++)); do
        kill -0 "$drive" 2>/dev/null || break
        sleep 0.05
    done
    kill -TERM "$drive" 2>/dev/null || true
    wait "$drive" || status=$?
    [ "$status" -eq "${1:-0}" ] || fail "the drive ends with $status: $(cat drive.err)"
    holds "($(value drive.json speed)) ^ 2 < 0.1 ^ 2" || fail "the axis turns: $(cat drive.json)"
    case $(value drive.json state) in
    measuring | stopping) fail "the drive ends in a run: $(cat drive.json)" ;;
    esac
}

# bad_cable FAULTS...: from vcan0, the master's side, to vcan1, the drive's.
bad_cable() {
    "$cable" vcan0 vcan1 "$@" >cable.out 2>cable.err &
    bridge=$!
    wait_for ready cable.out
}
cable_ends() { kill -TERM "$bridge" && wait "$bridge" || fail "the cable: $(cat cable.err)"; }

# command_ NAME ARGUMENTS...: into NAME.json, NAME.err; its exit code in $status. 15 s are too long.
command_() {
    local name=$1
    shift
    status=0
    timeout -k 1 15 "$servoid" command --can vcan0 --json "$@" >"$name.json" 2>"$name.err" || status=$?
    case $status in
    0 | 4 | 5) ;;
    *) fail "command $*: exit $status: $(cat "$name.err")" ;;
    esac
}

# What the faults do to a session and a move is held against the same on a good bus. A session in
# free-running time, so that nothing depends on this machine's speed but what is meant to.
amplitude=0.5
sines=(identify --amplitude $amplitude --frequency 50 100 --windows 3)
the_move=trapezoid:stroke=6.28,velocity=40

# J and its σ at 50 and 100 Hz, a line each.
inertias() {
    jq -r '.frequencies[].inertia | "\(.value) \(.std)"' "$1"
}
# same_inertia GOOD TESTED: within three of its σ, at both frequencies.
same_inertia() {
    paste <(inertias "$1") <(inertias "$2") | awk '
        { d = $3 - $1; if (d < 0) d = -d; if (!($4 > 0) || d > 3 * $4) exit 1; ++lines }
        END { exit lines != 2 }'
}

# heard_references LOG MODEL: every row in the log carries what the move asked for; "N rows, 0 wrong"
# in $rows.
heard_references() {
    [ -s "$2.ref.csv" ] ||
        "$servoid" simulate "$examples/$2.toml" --experiment $the_move --out "$2.ref.csv" --quiet
    awk -f "$scripts/references.awk" "$2.ref.csv" "$1" >rows.out ||
        fail "the drive followed another reference than was asked for: $(cat rows.out)"
    rows=$(cat rows.out)
}

# figure_of FAULT NAME HOW: one line of the table.
figure_of() { echo "figure: $1 | $2 | $3"; }
