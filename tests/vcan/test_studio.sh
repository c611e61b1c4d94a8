#!/usr/bin/env bash
# A studio with a drive on the bus: the move that tells two explanations apart is run from it, its
# samples arrive while it runs, and both captures together name the effect.
. "$(dirname "$0")/drive.sh"
sed '/^\[effects.coulomb/,$d' "$model" >frictionless.toml

# http METHOD PATH [BODY]: its answer; no program of the system is needed.
http() { python3 "$scripts/ask.py" "$@" || fail "$*"; }
state() { http GET "${url}api/state?after=-1"; }
do_() { http POST "${url}api/do" "$1" >/dev/null; }
wait_until() { # JQ-EXPRESSION WHAT
    local tries
    for ((tries = 0; tries < 200; tries++)); do
        state >state.json
        [ "$(jq "$1" state.json)" != true ] || return 0
        sleep 0.1
    done
    fail "$2: $(cut -c 1-2000 state.json)"
}

drive system1 vcan0 --torque-noise 1e-3
command_ one_way move constant_speed:velocity=20,duration=1 --out one_way.csv
[ $status -eq 0 ] || fail "$(cat one_way.err)"
"$servoid" studio frictionless.toml one_way.csv --can vcan0 --stroke 100 --json >url.json 2>studio.err &
studio=$!
for ((tries = 0; tries < 200; tries++)); do [ -s url.json ] && break; sleep 0.1; done
url=$(jq -r .url url.json)

wait_until '.busy == null and .experiment != null' "no experiment is recommended"
asked=$(jq -r .experiment.experiment state.json)
do_ "$(jq -c '{action: "run", experiment: .experiment.experiment}' state.json)"
wait_until '.can.running and .can.rows > 1000 and (.can.live.torque | length) > 50' "no sample arrives"
holds "$(jq '.can.live.time_s | (.[-1] - .[0])' state.json) > 0.1" || fail "no time passes"
wait_until '.busy == null and (.captures | length) == 2' "the run is no capture"
jq -e '.error == null and .captures[1].on and .captures[1].file == "vcan0-1.csv"' state.json >/dev/null ||
    fail "the capture: $(jq -c '.error, .captures' state.json)"

do_ '{"action": "diagnose"}'
sleep 0.2
wait_until '.busy == null' "the diagnosis does not end"
named=$(http GET "${url}api/story" | jq -r '.verdict, .diagnose.candidates[0].effect' | xargs)
[ "$named" = "missing coulomb" ] || fail "both together: $named"

# Stopped while it runs: the drive comes to rest, what was heard until then is a capture.
do_ '{"action": "run", "experiment": "trapezoid:stroke=6.28,velocity=20,cycles=50"}'
wait_until '.can.running and .can.rows > 2000' "the second run does not begin"
do_ '{"action": "stop"}'
wait_until '.busy == null and (.captures | length) == 3' "the stopped run is no capture"
jq -e '.error != null' state.json >/dev/null || fail "the stop is not told"
rows=$(jq '.captures[2].rows' state.json)
[ "$rows" -lt 80000 ] || fail "the stopped run has $rows rows"

kill -INT "$studio"
status=0
wait "$studio" || status=$?
[ "$status" -eq 0 ] || fail "the studio ends with $status: $(cat studio.err)"
drive_ends
echo "figure: studio on the bus: $asked run, then $named; stopped after $rows rows"
