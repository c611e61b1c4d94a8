# What the scripts of this folder have in common. They build for every board and run in QEMU, in a
# folder of their own that is gone afterwards.
set -euo pipefail
export LC_ALL=C
root=$(realpath "${SERVOID_SOURCE_DIR:?path of the source}")
here=$root/tests/boards
boards=(mps2_an386 mps2_an500 mps2_an505 mps3_an547 rv32_virt)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "FAILED: $*"; exit 1; }

build() { "$root/boards/build" "$@"; } # BOARD OUT SOURCE... [-- OPTION...]

# run BOARD PROGRAM: its text into PROGRAM.txt; the exit code must be 0.
run() {
    local status=0
    "$root/boards/run" "$1" "$2" 50 >"$2.txt" || status=$?
    [ "$status" -eq 0 ] || fail "$2 on $1: exit $status: $(tail -n 20 "$2.txt")"
}

# same FILE REFERENCE: bit for bit; says the first lines that are not.
same() {
    cmp -s "$1" "$2" || fail "$1 is not what $2 says: $(diff "$2" "$1" | head -n 10)"
    [ -s "$1" ] || fail "$1 is empty"
}
