#!/bin/sh
# Static figures of the core on a Cortex-M4: instructions and branches of the interrupt step at -O2, its stack, and
# the flash of each module at -Os. Fails when a budget is exceeded. The flash that is judged is what a session links;
# all modules together, with the loop, friction and the parts for use without a session, are printed only.   budget_m4.sh SOURCE_DIR WORK_DIR
set -eu
source_dir=$1
work=$2
cc=arm-none-eabi-gcc
command -v "$cc" >/dev/null || { echo "$cc is missing: apt install gcc-arm-none-eabi libnewlib-arm-none-eabi" >&2; exit 1; }
mkdir -p "$work"
flags="-std=c99 -mcpu=cortex-m4 -mthumb -I$source_dir/include"
"$cc" $flags -O2 -fstack-usage -c "$source_dir/src/sid_identify.c" -o "$work/step.o"
arm-none-eabi-objdump -d "$work/step.o" --disassemble=sid_identify_step | grep -E '^ +[0-9a-f]+:' | grep -v '\.word' >"$work/step.s"
steps=$(wc -l <"$work/step.s")
branches=$(awk -F'\t' '$3 ~ /^(b|bl|blx|bx|cbz|cbnz|tb[bh]|b[a-z][a-z])(\.[nw])?( |$)/ && $3 !~ /^bic/' "$work/step.s" | wc -l)
stack=$(awk -F'\t' '/sid_identify_step/ {print $2}' "$work/step.su")
total=0
for file in "$source_dir"/src/*.c; do
    name=$(basename "$file" .c)
    "$cc" $flags -Os -c "$file" -o "$work/$name.o"
    size=$(arm-none-eabi-size "$work/$name.o" | awk 'NR == 2 {print $1 + $2}')
    total=$((total + size))
    printf '%-16s %6d bytes\n' "$name" "$size"
    case $name in sid_bin | sid_inertia) pair=$((${pair:-0} + size)) ;; esac
done
# What a drive links: an empty port, without the port itself, start-up and C library.
flash_of() { # BOARD; its own code as it stands, or what its empty functions make needless would be left out
    "$cc" $flags -O0 -c "$source_dir/boards/$1"/*.c -o "$work/board_$1.o"
    "$cc" $flags -Os -ffunction-sections -fdata-sections -nostartfiles --specs=nosys.specs --specs=nano.specs \
        -Wl,--gc-sections,-e,main "$work/board_$1.o" "$source_dir"/src/*.c -o "$work/image_$1" 2>"$work/link.log" ||
        { cat "$work/link.log" >&2; exit 1; }
    arm-none-eabi-nm -S "$work/image_$1" | awk '$3 ~ /^[tTrR]$/ && $4 !~ /^(main|begin|power_up|give|serve_bus|mem|sid_hal|blank|__|_)/ {print $2}' |
        while read -r hex; do echo $((0x$hex)); done | awk '{n += $1} END {print n}'
}
"$cc" $flags -O2 -c "$source_dir/src/sid_node.c" -I"$source_dir/src" -o "$work/node.o"
image=$(flash_of blank)
node=$(flash_of blank_can)
node_step=$(arm-none-eabi-objdump -d "$work/node.o" --disassemble=sid_node_step | grep -E '^ +[0-9a-f]+:' | grep -vc '\.word')
divisions=$(arm-none-eabi-objdump -d "$work/node.o" --disassemble=sid_node_step | grep -cE 'div' || true)
echo "node: flash $node bytes with its session; its interrupt $node_step instructions beside the session's, $divisions divisions"
echo "flash: session $image bytes, sid_bin + sid_inertia $pair bytes, all modules $total bytes"
echo "interrupt step: $steps instructions ($branches branches), stack $stack bytes"
fail=0
over() { [ "$2" -le "$3" ] || { echo "over budget: $1 $2 > $3" >&2; fail=1; }; }
over instructions "$steps" 150
over branches "$branches" 0
over stack "$stack" 128
over "flash of a session" "$image" 8192
over "divisions in the node's interrupt" "$divisions" 0
over "sid_bin + sid_inertia" "$pair" 3072
exit $fail
