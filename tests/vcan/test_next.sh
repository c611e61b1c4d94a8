#!/usr/bin/env bash
# One move leaves two explanations; the move that tells them apart is run on the drive, from where it
# has to begin, and both captures together name the one.
. "$(dirname "$0")/drive.sh"
sed '/^\[effects.coulomb/,$d' "$model" >frictionless.toml
verdict() { "$servoid" diagnose frictionless.toml "$@" --json | jq -r '.verdict, .candidates[0].effect' | xargs; }

drive system1 vcan0 --torque-noise 1e-3
command_ one_way move constant_speed:velocity=20,duration=1 --out one_way.csv
[ $status -eq 0 ] || fail "$(cat one_way.err)"
first=$(verdict one_way.csv)
[[ $first == ambiguous* ]] || fail "one way: $first"

# Without anything to tell apart there is no next move.
status=0
"$servoid" command --can vcan0 next "$model" one_way.csv >none.json 2>none.err || status=$?
[ $status -eq 4 ] || fail "next of an adequate model: exit $status: $(cat none.err)"

timeout -k 1 30 "$servoid" command --can vcan0 --json next frictionless.toml one_way.csv \
    --out both_ways.csv >next.json 2>next.err || fail "next: $(cat next.err)"
drive_ends
asked=$(jq -r .experiment next.json)
[[ $asked == trapezoid:* ]] || fail "next was $asked"
value_is next.json lost 0
second=$(verdict one_way.csv both_ways.csv)
[ "$second" = "missing coulomb" ] || fail "both together: $second"
echo "figure: one way: $first; then $asked on the drive: $second"
