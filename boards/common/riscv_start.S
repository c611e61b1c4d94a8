# The first instructions of a RISC-V board; the rest is riscv.c.
    .section .vectors, "ax"
    .globl board_reset
board_reset:
    la sp, board_stack_high
    j board_run
