# What the replay tests have in common: see replay.c.
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
replay=("$here"/replay*.c)

build host reference "${replay[@]}"
run host reference
[ "$(grep -c '^ sums' reference.txt)" -ge 50 ] || fail "few windows: $(wc -l <reference.txt) lines"

# replays BOARD OPTION...: as the PC's gcc -O2; the program stays as `program`.
replays() {
    build "$1" program "${replay[@]}" -- "${@:2}"
    run "$1" program
    cmp -s program.txt reference.txt || fail "$*: $(diff reference.txt program.txt | head -n 10)"
    echo "$*: the same $(wc -l <program.txt) lines"
    count=$((${count-0} + 1))
}

# How often a program adds four sums with the instructions written out in sid_bin.h.
written_out() { arm-none-eabi-objdump -d program | grep -cE 'ldmia.*\{r4, r5, r6, r8, r9, sl, fp, ip\}' || true; }
