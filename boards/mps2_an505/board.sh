# Cortex-M33, all of it in the secure state it boots in: Arm MPS2 with FPGA image AN505.
compiler=arm-none-eabi-gcc
cpu=(-mcpu=cortex-m33 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16)
clock_Hz=20000000
code=(0x10000000 0x40000)
data=(0x38000000 0x40000)
sources=(common/cortex_m.c common/semihosting.c common/text.c common/memory.c)
run=(qemu-system-arm -M mps2-an505)
