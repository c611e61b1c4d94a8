# Runs in whose middle something breaks.
. "$(dirname "$0")/drive.sh"

drive system1 vcan0 --free
command_ good --free "${sines[@]}"
drive_ends

# broken FAULT AT COMMAND EXIT TEXT HOW WHAT...: TEXT is what the master says on stderr, or a filter
# that its answer must fulfil.
broken() {
    local fault=$1 expected=$4 text=$5 how=$6
    bad_cable --at "$2" "$3"
    drive system1 vcan1 $how
    command_ broken $how "${@:7}"
    [ $status -eq "$expected" ] || fail "$fault: exit $status, $expected was expected: $(cat broken.err)"
    if [ $status -eq 5 ]; then
        said broken.err "$text"
        text="exit 5, $(cut -c10- broken.err | tail -n 1)"
    else
        [ "$(jq "$text" broken.json)" = true ] || fail "$fault: $text: $(jq -c .bus,.link broken.json)"
    fi
    drive_ends "${drive_exit:-0}"
    cable_ends
    figure_of "$fault" "${7}${how:+, free-running}" "$text; drive: $(value drive.json state), $(value drive.json reason)"
}
moving=(move "$the_move" --out broken.csv --log broken.log)

