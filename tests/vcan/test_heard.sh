#!/usr/bin/env bash
# A log that is played onto a bus, heard there, gives the numbers of the log, to the last digit. So
# does what candump wrote of the same run, and what replay saved of it.
. "$(dirname "$0")/support.sh"
make_logs
frames=$(wc -l <counter.log)
"$servoid" replay x.log --profile cia402 --objects 6041 6064 6074 --model "$model" --period 125e-6 \
    --json >log.json
[ "$(identified log.json | grep -c value)" -ge 3 ] || fail "nothing was identified in the log"

candump -r 8000000 -L vcan0 >dump.log &
dump=$!
listen live --map counter.toml --idle 1.5 --log saved.log --out saved.csv
canplayer -I counter.log vcan0=can0
ended live 0
kill $dump

bus_is live.json frames "$frames"
for key in lost repeated late reordered short errors dropped bus_off interface_down; do
    [ $key = late ] || bus_is live.json $key 0
done
expect "the live bus gives other numbers than the log" same_numbers log.json live.json
for heard in dump saved; do
    [ "$(wc -l <$heard.log)" -eq "$frames" ] || fail "$heard.log has $(wc -l <$heard.log) frames"
    "$servoid" replay $heard.log --map counter.toml --model "$model" --period 125e-6 --json >$heard.json
    expect "$heard.log gives other numbers" same_numbers log.json $heard.json
done
expect "saved.log is not what candump wrote" cmp \
    <(cut -d' ' -f2- dump.log) <(cut -d' ' -f2- saved.log)
[ "$(grep -c '^[0-9]' saved.csv)" -eq "$frames" ] || fail "saved.csv has not one row a frame"
echo "figure: $frames frames at 8 kHz over a virtual bus, 0 lost: every number as of the log"

# So does a drive that answers SYNC, though its frames come in bursts from a player: with the cycle
# stated, each SYNC is the next one.
listen synced --profile cia402 --objects 6041 6064 6074 --idle 1.5
canplayer -I x.log vcan0=can0
ended synced 0
bus_is synced.json lost 0
bus_is synced.json repeated 0
expect "SYNC by SYNC other numbers than the log" same_numbers log.json synced.json

# The user ends it, and what came until then is evaluated.
listen ended --map counter.toml --idle 60
canplayer -I counter.log vcan0=can0
sleep 0.3
kill -INT "$listener"
ended ended 0
expect "Ctrl-C changes the numbers" same_numbers log.json ended.json

# So long and no longer.
listen short --map counter.toml --for 0.2 --log short.log
for i in 1 2 3; do canplayer -I counter.log vcan0=can0; done &
ended short 0
(($(wc -l <short.log) < 2 * frames)) || fail "--for 0.2 recorded $(wc -l <short.log) frames"
wait
