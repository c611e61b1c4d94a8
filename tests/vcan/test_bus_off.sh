#!/usr/bin/env bash
# What error frames say of the bus is counted and named, and what was heard before bus off is kept.
. "$(dirname "$0")/support.sh"
make_logs
frames=$(wc -l <counter.log)
half=$((frames / 2))
head -n $half counter.log >first.log
tail -n +$((half + 1)) counter.log >second.log
"$servoid" replay counter.log --map counter.toml --model "$model" --period 125e-6 --json >whole.json

# The controller leaves the bus, and comes back: it goes on.
listen restarted --map counter.toml --idle 1 --log restarted.log
canplayer -I first.log vcan0=can0
cansend vcan0 20000004#0004000000000000 # warning
cansend vcan0 20000004#0010000000000000 # passive
cansend vcan0 20000040#0000000000000000 # off
cansend vcan0 20000100#0000000000000000 # restarted
canplayer -I second.log vcan0=can0
ended restarted 0
bus_is restarted.json frames $((frames + 4))
bus_is restarted.json errors 4
for key in error_warning error_passive bus_off restarted; do bus_is restarted.json $key 1; done
expect "the pause changes the numbers" same_numbers whole.json restarted.json
"$servoid" replay restarted.log --map counter.toml --model "$model" --period 125e-6 >text
said text "bus off 1, restarted 1, error passive 1, error warning 1"

# It stays off.
listen off --map counter.toml --idle 1 --log off.log --out off.csv
canplayer -I first.log vcan0=can0
cansend vcan0 20000040#0000000000000000
ended off 5
said off.err "vcan0: bus off"
[ "$(wc -l <off.log)" -eq $((half + 1)) ] || fail "off.log has $(wc -l <off.log) lines"
[ "$(grep -c '^[0-9]' off.csv)" -eq $half ] || fail "off.csv has not one row a frame"
[ ! -s off.json ] || fail "a fault of the bus left an answer"
