#!/usr/bin/env bash
# A session from a timer interrupt of 8 kHz finds the inertia of system 1, on every board and on the
# PC, with the same digits. A second one, on the boards, is polled all the time and so interrupted in
# the middle of polls.
. "$(dirname "$0")/support.sh"
drive=("$root"/boards/drive/{plant,drive}.c)

build host host "${drive[@]}" "$root/boards/drive/identify.c"
run host host
sed -n 's/^\(.*Hz: J.*\), D .*/figure: boards: \1, the same digits on the PC and in QEMU on M4, M7, M33, M55, RV32/p' host.txt
while IFS= read -r line; do
    grep -qF -- "$line" "$root/boards/README.md" || fail "not in boards/README.md: $line"
done < <(grep Hz host.txt)
for board in "${boards[@]}"; do
    build "$board" "$board" "${drive[@]}" "$root/boards/drive/identify.c"
    run "$board" "$board"
    same "$board.txt" host.txt
    build "$board" "$board.preempted" "${drive[@]}" "$here/preempted.c"
    run "$board" "$board.preempted"
    sed "s/^/$board: /" "$board.preempted.txt"
done
