#!/usr/bin/env bash
# The port to the STM32G474. Its image: vectors, what it links, start-up, flash and RAM as its README
# says. Its code, on fake registers, on the PC and on a Cortex-M4: what it writes gives the clock, rates
# and bit timings that are claimed; frames of every length; a session on a simulated motor; every fault.
. "$(dirname "$0")/support.sh"
port=$root/boards/stm32g474
tests=$here/stm32g474

# ---------------------------------------------------------------- the image

address() { echo $((0x$(arm-none-eabi-nm "$1" | awk -v name="$2" '$3 == name { print $1 }'))); } # IMAGE SYMBOL
vector() { echo $((0x$(od -An -v -tx4 -w4 "$1.bin" | awk -v n="$2" 'NR == n + 1 { print $1 }'))); } # IMAGE INDEX

check_vectors() { # IMAGE
    arm-none-eabi-objcopy -O binary "$1" "$1.bin"
    [ "$(address "$1" vectors)" -eq $((0x08000000)) ] || fail "$1: vectors not at the start of flash"
    [ "$(vector "$1" 0)" -eq "$(address "$1" image_stack_high)" ] || fail "$1: initial stack"
    [ "$(vector "$1" 0)" -gt $((0x20000000)) ] && [ $(($(vector "$1" 0) % 8)) -eq 0 ] || fail "$1: stack"
    [ "$(vector "$1" 1)" -eq $(($(address "$1" reset) + 1)) ] || fail "$1: reset vector"
    [ "$(vector "$1" 3)" -eq $(($(address "$1" fault) + 1)) ] || fail "$1: hard fault vector"
    [ "$(vector "$1" $((16 + 18)))" -eq $(($(address "$1" ADC1_2_IRQHandler) + 1)) ] ||
        fail "$1: interrupt 18 is not the control interrupt"
}

check_links() { # IMAGE
    [ -z "$(arm-none-eabi-nm -u "$1")" ] || fail "$1: undefined: $(arm-none-eabi-nm -u "$1")"
    local alien
    alien=$(arm-none-eabi-nm "$1" | grep -iE ' (_?malloc|_?free|_?sbrk|_impure|.*printf|__libc|_exit|__aeabi_c?[df]|__aeabi_.*2[df]$)' || true)
    [ -z "$alien" ] || fail "$1: a heap, a C library or software floating point: $alien"
    local function code
    for function in ADC1_2_IRQHandler sid_hal_read sid_hal_write_reference drive_control sid_node_step; do
        code=$(arm-none-eabi-objdump -d --disassemble="$function" "$1")
        [ "$(grep -c $'^ .*\t' <<<"$code")" -ge 5 ] || fail "$1: no $function"
        ! grep -E $'\t[su]div|__aeabi_.*div' <<<"$code" || fail "$1: a division in $function"
    done
}

# On the nearest part that is emulated, an STM32F405: the same core, flash and SRAM at the same places,
# but no crystal that ever gets ready. The image starts up, and stays in main.
check_boot() { # IMAGE
    local pc start size
    (for _ in 1 2 3 4; do sleep 0.5; echo 'info registers'; done
        echo 'xp /1xw 0xe000ed88'; echo 'xp /1xw 0xe000ed08'; echo quit) |
        timeout 50 qemu-system-arm -M netduinoplus2 -display none -serial none -monitor stdio -kernel "$1" \
            >boot.txt || fail "$1: does not start: $(tail -n 3 boot.txt)"
    pc=$((0x$(sed -n 's/.*R15=\([0-9a-f]*\).*/\1/p' boot.txt | tail -n 1)))
    read -r start size < <(arm-none-eabi-nm -S "$1" | awk '$4 == "main" { print $1, $2 }')
    ((pc >= 0x$start && pc < 0x$start + 0x$size)) || fail "$1: is at $pc, not in main"
    grep -q 'e000ed88: 0x00f00000' boot.txt || fail "$1: the FPU is off"
    grep -q 'e000ed08: 0x08000000' boot.txt || fail "$1: VTOR is not the flash"
}

row() { printf '| %s |' "$1"; printf ' %s |' "${@:2}"; echo; } # NAME CELL...
flash=() ram=()
for level in -O2 -Os; do
    build stm32g474 "image$level" "$port"/*.c -- $level
    check_vectors "image$level"
    check_links "image$level"
    check_boot "image$level"
    read -r text data bss < <(arm-none-eabi-size "image$level" | awk 'NR == 2 { print $1, $2, $3 }')
    flash+=($((text + data))) ram+=($((data + bss)))
    ((text + data <= 32768)) || fail "$level: $((text + data)) bytes of flash"
    ((data + bss <= 32768)) || fail "$level: $((data + bss)) bytes of RAM"
done
row 'flash' "${flash[@]}" >sizes.txt
row 'RAM, 4096 of them stack' "${ram[@]}" >>sizes.txt
while IFS= read -r line; do
    grep -qxF -- "$line" "$port/README.md" || fail "not in boards/stm32g474/README.md: $line"
done <sizes.txt
echo "figure: STM32G474: ${flash[0]} bytes of flash at -O2, ${flash[1]} at -Os; ${ram[0]} of RAM, not run on silicon"

# No emulator: said, and not taken for a program of the PC.
status=0
"$root/boards/run" stm32g474 image-O2 2>message.txt || status=$?
[ $status -eq 2 ] && grep -q 'not emulate' message.txt || fail "boards/run: exit $status, $(cat message.txt)"

# ---------------------------------------------------------------- its code, executed

code=("$port"/{clock,drive_loop,fdcan,power_stage,servo}.c)
fake() { # BOARD NAME OPTION...
    build "$1" "$2.$1" "$tests/fake.c" "$tests/$2.c" "${code[@]}" -- -DSTM32G474_FAKE "-I$port" "${@:3}"
    run "$1" "$2.$1"
    same "$2.$1.txt" "$tests/$2.txt"
}
for name in registers run; do
    fake host "$name" -O1 -fsanitize=undefined -fno-sanitize-recover=all
    fake host "$name" -O2
    fake mps2_an386 "$name" -O2
    fake mps2_an386 "$name" -Os
    sed 's/^/figure: STM32G474, code on fake registers: /' "$tests/$name.txt"
done
