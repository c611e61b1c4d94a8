// Start-up, faults and machine timer of an RV32 with a CLINT.
#include "board.h"

#define REGISTER(address) (*(volatile uint32_t*)(address))
#define MTIMECMP_LOW REGISTER(0x02004000U)
#define MTIMECMP_HIGH REGISTER(0x02004004U)
#define MTIME_LOW REGISTER(0x0200BFF8U)
#define MTIME_HIGH REGISTER(0x0200BFFCU)
#define MCAUSE_MACHINE_TIMER 0x80000007U
#define MIE_MACHINE_TIMER 0x80U
#define MSTATUS_INTERRUPTS 0x8U

#define FAULT_EXIT 3

#define CSR_READ(name, value) __asm__ volatile("csrr %0, " #name : "=r"(value))
#define CSR_WRITE(name, value) __asm__ volatile("csrw " #name ", %0" ::"r"(value) : "memory")
#define CSR_SET(name, bits) __asm__ volatile("csrs " #name ", %0" ::"r"(bits) : "memory")
#define CSR_CLEAR(name, bits) __asm__ volatile("csrc " #name ", %0" ::"r"(bits) : "memory")

extern uint32_t board_data_start[], board_data_end[], board_data_load[];
extern uint32_t board_bss_start[], board_bss_end[];

void board_run(void);

__attribute__((weak)) void board_timer_interrupt(void) {}

static uint64_t due;
static uint32_t period;

// All ones first: neither half alone may look like a time that has come.
static void arm_timer(void) {
    MTIMECMP_HIGH = UINT32_MAX;
    MTIMECMP_LOW = (uint32_t)due;
    MTIMECMP_HIGH = (uint32_t)(due >> 32);
}

__attribute__((interrupt("machine"), aligned(4))) static void trap(void) {
    uint32_t cause;
    CSR_READ(mcause, cause);
    if (cause != MCAUSE_MACHINE_TIMER) {
        board_print("fault, mcause ");
        board_print_int(cause);
        board_print("\n");
        board_exit(FAULT_EXIT);
    }
    due += period;
    arm_timer();
    board_timer_interrupt();
}

void board_run(void) {
    for (uint32_t* at = board_bss_start; at < board_bss_end; at++) {
        *at = 0;
    }
    for (uint32_t* at = board_data_start; at < board_data_end; at++) {
        *at = board_data_load[at - board_data_start];
    }
    CSR_WRITE(mtvec, (uint32_t)(uintptr_t)trap);
    board_exit(main());
}

static uint64_t now(void) {
    uint32_t high;
    uint32_t low;
    do {
        high = MTIME_HIGH;
        low = MTIME_LOW;
    } while (high != MTIME_HIGH);
    return ((uint64_t)high << 32) | low;
}

void board_timer_start(uint32_t rate_Hz) {
    period = BOARD_CLOCK_HZ / rate_Hz;
    due = now() + period;
    arm_timer();
    CSR_SET(mie, MIE_MACHINE_TIMER);
}

uint32_t board_timer_ticks(void) { return (uint32_t)(now() - (due - period)); }

void board_wait(void) { __asm__ volatile("wfi" ::: "memory"); }
void board_interrupt_off(void) { CSR_CLEAR(mstatus, MSTATUS_INTERRUPTS); }
void board_interrupt_on(void) { CSR_SET(mstatus, MSTATUS_INTERRUPTS); }
