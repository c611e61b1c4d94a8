# Cortex-M4F of a drive: STM32G474RE. A port of its own; QEMU has no such part.
compiler=arm-none-eabi-gcc
cpu=(-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16)
script=stm32g474/stm32g474.ld
sources=(common/memory.c)
not_run="a drive's own part, which QEMU does not emulate: tests/boards/test_stm32g474.sh executes its code"
