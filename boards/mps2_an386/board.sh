# Cortex-M4 with single-precision FPU: Arm MPS2 with FPGA image AN386.
compiler=arm-none-eabi-gcc
cpu=(-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16)
clock_Hz=25000000
code=(0x00000000 0x40000)
data=(0x20000000 0x40000)
sources=(common/cortex_m.c common/semihosting.c common/text.c common/memory.c)
run=(qemu-system-arm -M mps2-an386)
