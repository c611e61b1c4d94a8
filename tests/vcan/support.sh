# What the scripts of this folder have in common. They run on a machine that has vcan0 and vcan1
# (tools/with-vcan), in a folder of their own that is gone afterwards.
set -euo pipefail
export LC_ALL=C
servoid=$(realpath "${SERVOID_PROGRAM:?path of the built program}")
examples=$(realpath "${SERVOID_SOURCE_DIR:?path of the source}")/examples
model=$examples/system1.toml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "FAILED: $*"; exit 1; }

# expect WHAT COMMAND...: the command succeeds.
expect() { "${@:2}" || fail "$1"; }

# 0.4 s of a sine as a log of SYNC and TPDO: x.log. The same as counter.log, with a counter in place
# of the status word and no SYNC: a PC sends and receives in bursts, so only what counts itself is
# certain to stand in the cycle that it was in.
make_logs() {
    "$servoid" simulate "$model" --experiment sine:frequency_Hz=50,periods=20,amplitude=0.5 \
        --out x.log --quiet
    awk '/ 181#/ { n = cycle++ % 65536
                   sub(/181#..../, sprintf("181#%02X%02X", n % 256, n / 256)); print }' x.log >counter.log
    cat >counter.toml <<'END'
[bus.counter]
id = 0x181
start_bit = 0
length = 16
[signals.position_count]
id = 0x181
start_bit = 16
length = 32
signed = true
[signals.torque_ref_permille]
id = 0x181
start_bit = 48
length = 16
signed = true
END
}

# listen NAME OPTIONS...: replay of vcan0 in the background, into NAME.json and NAME.err; its process
# in $listener. Returns when it listens.
listen() {
    local name=$1
    shift
    : >"$name.err"
    "$servoid" replay --can vcan0 --model "$model" --period 125e-6 --json "$@" \
        >"$name.json" 2>"$name.err" &
    listener=$!
    local tries
    for ((tries = 0; tries < 100; tries++)); do
        ! grep -q listening "$name.err" || return 0
        kill -0 "$listener" 2>/dev/null || break
        sleep 0.05
    done
    fail "$name does not listen: $(cat "$name.err")"
}

# ended NAME STATUS: the listener ends with that exit code.
ended() {
    local status=0
    wait "$listener" || status=$?
    [ "$status" -eq "$2" ] || fail "$1: exit $status, $2 was expected: $(cat "$1.err")"
}

# What was identified: everything but the bus.
identified() { sed '/"bus": {/,$d' "$1"; }
same_numbers() { cmp <(identified "$1") <(identified "$2"); }

# bus FILE KEY: of the JSON's bus.
bus() { sed -n '/"bus": {/,$ s/^ *"'"$2"'": \([^,]*\),\{0,1\}$/\1/p' "$1"; }
bus_is() { # FILE KEY VALUE
    [ "$(bus "$1" "$2")" = "$3" ] || fail "$1: bus $2 is $(bus "$1" "$2"), $3 was expected"
}

said() { grep -qF -- "$2" "$1" || fail "$1 does not say \"$2\": $(cat "$1")"; } # FILE TEXT
