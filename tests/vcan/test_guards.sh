#!/usr/bin/env bash
# Stroke and torque are watched by the drive itself, and hold the axis while its master is stopped.
. "$(dirname "$0")/drive.sh"

# A move whose guard will trip half a second after the start; by then the master is stopped. The
# references that it has sent last for a second.
limits=()
guard_acts() { # NAME REASON MODEL EXPERIMENT DRIVE'S OPTIONS...
    local master status=0
    rm -f master
    bad_cable --at 100 'kill -STOP $(cat master)'
    drive "$3" vcan1 --timeout 5000 "${@:5}"
    "$servoid" command --can vcan0 --json --timeout 5000 "${limits[@]}" move "$4" --out guarded.csv \
        >guarded.json 2>guarded.err &
    master=$!
    echo $master >master
    wait_for "State:	T" /proc/$master/status
    sleep 1.2
    command_ status --master 126 status # the drive answers, and its master has said nothing yet
    value_is status.json state aborted
    value_is status.json reason "$2"
    kill -CONT $master
    wait $master || status=$?
    [ $status -eq 5 ] || fail "$1: the master ends with $status: $(cat guarded.err)"
    said guarded.err "the drive ended the run: $2"
    drive_ends
    value_is drive.json reason "$2"
    cable_ends
    figure_of "$1, the master stopped" move "drive: $2; $(cut -c10- guarded.err | tail -n 1)"
}

guard_acts "stroke guard of the drive" "aborted: stroke" system1 \
    trapezoid:stroke=12.6,velocity=20 --stroke 6.5
# The friction grows with the speed, up to 12.8 mNm.
limits=(--torque-limit 0.0115)
guard_acts "torque guard of the drive" "aborted: torque" system1 \
    trapezoid:stroke=40,velocity=60,acceleration=150

# A drive whose torque is cut off at its limit: no inertia is made of it. A guard wider than the
# drive's own is refused.
mkdir limited && sed 's/^rated_torque.*/&\ntorque_limit = 0.03/' "$examples/system1.toml" >limited/cut.toml
examples=$work/limited
drive cut vcan0 --free
command_ cut --free identify --amplitude 0.5 --frequency 50 100
[ $status -eq 4 ] || fail "a torque that is cut off: exit $status: $(cat cut.err cut.json)"
said cut.err "torque saturated"
said cut.err "a smaller amplitude"
status=0
"$servoid" command --can vcan0 --free --torque-limit 0.05 identify --amplitude 0.1 2>wide.err || status=$?
[ $status -eq 2 ] || fail "a wider guard: exit $status: $(cat wide.err)"
said wide.err "--torque-limit: wider than the drive itself allows"
drive_ends
figure_of "drive.torque_limit reached" identify "exit 4, $(cut -c10- cut.err | head -n 1)"
