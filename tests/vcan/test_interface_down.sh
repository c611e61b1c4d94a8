#!/usr/bin/env bash
# An interface that goes down, comes back or is taken away while it is heard.
. "$(dirname "$0")/support.sh"
make_logs
frames=$(wc -l <counter.log)
half=$((frames / 2))
head -n $half counter.log >first.log
tail -n +$((half + 1)) counter.log >second.log
"$servoid" replay counter.log --map counter.toml --model "$model" --period 125e-6 --json >whole.json

# The interface goes down, and up again within the time: it goes on.
listen up --map counter.toml --idle 1 --log up.log
canplayer -I first.log vcan0=can0
ip link set vcan0 down
sleep 1.3 # longer than --idle: the drive did not fall silent
ip link set vcan0 up
canplayer -I second.log vcan0=can0
ended up 0
bus_is up.json interface_down 1
bus_is up.json frames "$frames"
expect "the pause changes the numbers" same_numbers whole.json up.json

# It stays down, in the middle of the move.
listen down --map counter.toml --log down.log --out down.csv
canplayer -I counter.log vcan0=can0 2>/dev/null &
sleep 0.15
ip link set vcan0 down
ended down 5
wait || true
said down.err "vcan0: the interface is down: \`ip link set vcan0 up"
kept=$(wc -l <down.log)
((kept > 0 && kept < frames)) || fail "down.log has $kept lines"
"$servoid" replay down.log --map counter.toml --model "$model" --period 125e-6 --quiet ||
    [ $? -eq 4 ] || fail "down.log is no log"
ip link set vcan0 up

# It is taken away.
listen gone --map counter.toml --log gone.log
canplayer -I first.log vcan0=can0
ip link del vcan0
ended gone 5
said gone.err "vcan0: the interface is gone"
[ "$(wc -l <gone.log)" -eq $half ] || fail "gone.log has $(wc -l <gone.log) lines"
