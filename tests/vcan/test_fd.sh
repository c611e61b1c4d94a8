#!/usr/bin/env bash
# FD frames of 29-bit identifiers through a map, while others talk, classic and FD: the same numbers,
# and of the others nothing.
. "$(dirname "$0")/support.sh"
make_logs
# counter of 32 bits, position, torque, padded to 12 bytes
awk '/ 181#/ { data = substr($3, 9); n = cycle++
               printf "%s can0 18FF0181##1%02X%02X0000%s0000\n", $1, n % 256, n / 256, data }' x.log >fd.log
sed 's/0x181/0x18FF0181\nextended = true/; s/start_bit = 48/start_bit = 64/
     s/start_bit = 16/start_bit = 32/' counter.toml >fd.toml
frames=$(wc -l <fd.log)
"$servoid" replay x.log --profile cia402 --objects 6041 6064 6074 --model "$model" --period 125e-6 \
    --json >log.json

cangen vcan0 -g 0.2 -I 181 -e -L r -D r & # the same number, but of 29 bits
classic=$!
cangen vcan0 -g 0.2 -I 701 -f -L r -D r &
fd=$!
listen live --map fd.toml --idle 1.5 --log saved.log
canplayer -I fd.log vcan0=can0
ended live 0
kill -0 $classic $fd 2>/dev/null || fail "nobody else talked"
kill $classic $fd
bus_is live.json frames "$frames"
for key in lost short errors dropped; do bus_is live.json $key 0; done
expect "FD frames give other numbers" same_numbers log.json live.json
# newer kernels set a bit in the flags of all FD frames
expect "saved.log is not what was played" cmp \
    <(cut -d' ' -f3 fd.log) <(cut -d' ' -f3 saved.log | sed 's/##5/##1/')
