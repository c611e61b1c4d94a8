# Cortex-M55 with vector extension, in the secure state it boots in: Arm MPS3 with FPGA image AN547.
compiler=arm-none-eabi-gcc
cpu=(-mcpu=cortex-m55 -mthumb -mfloat-abi=hard -mfpu=auto)
clock_Hz=32000000
code=(0x10000000 0x40000)
data=(0x30000000 0x40000)
sources=(common/cortex_m.c common/semihosting.c common/text.c common/memory.c)
run=(qemu-system-arm -M mps3-an547)
