#!/usr/bin/env bash
# Two others fill the bus with frames, without a gap between them, twice what a bus of 1 Mbit/s
# carries: sessions and moves as on a quiet one, or a refusal that says why.
. "$(dirname "$0")/drive.sh"

drive system1 vcan0 --free
command_ good --free "${sines[@]}"
drive_ends

load() { # frames that nobody asked for
    cangen vcan0 -g 0 -I 3A0 -L 8 -D i -p 1 >/dev/null 2>&1 &
    loads+=($!)
}
loaded() { # HOW EXITS WHAT...
    local before after seconds
    loads=()
    drive system1 vcan0 $1
    load && load
    before=$(frames) seconds=$(cut -d' ' -f1 /proc/uptime)
    command_ full $1 "${@:3}"
    after=$(frames) seconds=$(awk "BEGIN { print $(cut -d' ' -f1 /proc/uptime) - $seconds }")
    kill -0 "${loads[@]}" || fail "the load ended"
    kill "${loads[@]}" && wait "${loads[@]}" || true
    [[ " $2 " == *" $status "* ]] || fail "exit $status: $(cat full.err)"
    drive_ends
    figure_of "$(awk "BEGIN { printf \"%.0f\", ($after - $before) / $seconds }") other frames/s" "${3}${1:+, free-running}" \
        "exit $status; $(cut -c10- full.err | tail -n 1)$(jq -c '.link | {dropped, repeated_requests}' full.json 2>/dev/null); drive: lost_time_s $(value drive.json lost_time_s)"
}
frames() { awk '/vcan0:/ { n += $3 } END { print n }' /proc/net/dev; }

loaded --free 0 "${sines[@]}"
expect "a full bus: another inertia" same_inertia good.json full.json
loaded --free 0 move "$the_move" --log full.log
heard_references full.log system1
loaded "" "0 5" move "$the_move"
