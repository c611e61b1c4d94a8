#!/usr/bin/env bash
# Over the bus as beside it: a session gives the inertia that the same sine gives offline, and a move
# on a drive that hides something gives a capture in which diagnose finds what it hides.
. "$(dirname "$0")/drive.sh"

for model in system1 system2; do
    for hz in 50 100; do
        drive $model vcan0 --free # from rest, with an empty integrator
        command_ session --free identify --amplitude $amplitude --frequency $hz
        [ $status -eq 0 ] || fail "$model at $hz Hz: exit $status: $(cat session.err)"
        drive_ends
        "$servoid" simulate "$examples/$model.toml" --out offline.csv --quiet \
            --experiment sine:frequency_Hz=$hz,periods=11,amplitude=$amplitude
        "$servoid" identify offline.csv --frequency $hz --json >offline.json
        bus=$(jq .inertia.value session.json) file=$(jq .inertia.value offline.json)
        holds "($bus / $file - 1) ^ 2 < 0.001 ^ 2" || fail "$model at $hz Hz: $bus, offline $file"
        echo "figure: $model at $hz Hz: J $bus over the bus, $file offline:" \
            "$(awk "BEGIN { printf \"%+.3f\", 100 * ($bus / $file - 1) }") %"
    done
done

# hidden MODEL SEED MOVE
hidden() {
    local truth found next=""
    "$servoid" simulate "$examples/$1.toml" --mystery "$2" --experiment "$3" --out secret.csv --quiet
    truth=$("$servoid" reveal secret.csv --json | jq -r .effect)
    drive "$1" vcan0 --free --mystery "$2" --hidden-for "$3"
    command_ move --free move "$3" --out m.csv
    [ $status -eq 0 ] || fail "seed $2: exit $status: $(cat move.err)"
    "$servoid" diagnose "$examples/$1.toml" m.csv --json >diagnosis.json
    if [ "$(jq -r .verdict diagnosis.json)" = ambiguous ]; then
        command_ next --free next "$examples/$1.toml" m.csv --out next.csv
        [ $status -eq 0 ] || fail "seed $2, next: exit $status: $(cat next.err)"
        next=", after $(jq -r .experiment next.json)"
        "$servoid" diagnose "$examples/$1.toml" m.csv next.csv --json >diagnosis.json
    fi
    drive_ends
    found=$(jq -r '.verdict + " " + .candidates[0].effect' diagnosis.json)
    echo "figure: $1, seed $2: hidden $truth, found $found$next"
    [ "$found" = "missing $truth" ] || fail "seed $2: $truth is hidden, $found was found"
}
for seed in ${SEEDS:-1 2 4 5}; do hidden system1 $seed "$the_move"; done
