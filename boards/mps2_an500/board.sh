# Cortex-M7 with double-precision FPU: Arm MPS2 with FPGA image AN500.
compiler=arm-none-eabi-gcc
cpu=(-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16)
clock_Hz=25000000
code=(0x00000000 0x40000)
data=(0x20000000 0x40000)
sources=(common/cortex_m.c common/semihosting.c common/text.c common/memory.c)
run=(qemu-system-arm -M mps2-an500)
