#!/usr/bin/env bash
# 8000 samples a second for a minute, in real time: every one of them is received.
. "$(dirname "$0")/drive.sh"
seconds=${LIVE_SECONDS:-60}

drive_for=$((seconds + 60)) drive system1 vcan0
status=0
timeout -k 1 $((seconds + 15)) "$servoid" command --can vcan0 --json --timeout 5000 \
    move constant_speed:velocity=5,duration=$seconds --out live.csv >live.json 2>live.err || status=$?
[ $status -eq 0 ] || fail "exit $status: $(cat live.err)"
drive_ends
rows=$(jq .samples live.json)
((rows >= 8000 * seconds)) || fail "$rows samples: $(cat live.json)"
for key in lost dropped repeated short; do [ "$(jq .bus.$key live.json)" -eq 0 ] || fail "$key: $(jq -c .bus live.json)"; done
[ "$(jq .telemetry_rows_lost drive.json)" -eq 0 ] || fail "$(cat drive.json)"
holds "$(jq .lost_time_s drive.json) < 0.1 * $seconds" || fail "real time was lost: $(cat drive.json)"
echo "figure: $rows samples at $(jq '1 / .bus.period_s | round' live.json) samples/s over FD frames, 0 lost, 0 dropped;" \
    "drive: lost_time_s $(jq .lost_time_s drive.json), jitter $(jq .bus.jitter_s live.json) s"
