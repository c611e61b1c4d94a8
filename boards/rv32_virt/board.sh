# RV32IMAC, no FPU: QEMU's virt machine with the core of a SiFive E31.
compiler=riscv64-unknown-elf-gcc
# the older specification still counts the control registers to the base
cpu=(-march=rv32imac -misa-spec=2.2 -mabi=ilp32 -mcmodel=medany -msmall-data-limit=0 -ffreestanding
    -isystem "$boards/common/without_libc")
clock_Hz=10000000
code=(0x80000000 0x40000)
data=(0x80040000 0x40000)
sources=(common/riscv_start.S common/riscv.c common/semihosting.c common/text.c common/memory.c)
run=(qemu-system-riscv32 -M virt -cpu sifive-e31 -bios none)
