// Start-up, faults and SysTick of Cortex-M3, M4, M7, M33 and M55.
#include "board.h"

#include <string.h>

#define REGISTER(address) (*(volatile uint32_t*)(address))
#define SYST_CSR REGISTER(0xE000E010U)
#define SYST_RVR REGISTER(0xE000E014U)
#define SYST_CVR REGISTER(0xE000E018U)
#define CFSR REGISTER(0xE000ED28U)
#define CPACR REGISTER(0xE000ED88U)
#define SYST_ENABLE_WITH_INTERRUPT_FROM_CORE_CLOCK 7U
#define SYST_COUNTFLAG (1U << 16)
#define CPACR_FPU_FULL_ACCESS (0xFU << 20)

#define FAULT_EXIT 3

extern uint32_t board_data_start[], board_data_end[], board_data_load[];
extern uint32_t board_bss_start[], board_bss_end[];

void board_reset(void);
void board_fault(void);

__attribute__((weak)) void board_timer_interrupt(void) {}

typedef void (*board_vector_t)(void);
typedef struct {
    uint32_t* stack;
    board_vector_t vector[15];
} board_vectors_t;

extern const board_vectors_t board_vectors;
__attribute__((section(".vectors"), used)) const board_vectors_t board_vectors = {
    board_stack_high,
    {board_reset, board_fault, board_fault, board_fault, board_fault, board_fault, board_fault, 0,
     0, 0, board_fault, board_fault, 0, board_fault, board_timer_interrupt}};

// Before the FPU is on, no instruction of it may run: the compiler likes its registers for copies.
static void enable_fpu(void) {
    CPACR |= CPACR_FPU_FULL_ACCESS;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
}

static void run(void) {
    for (uint32_t* at = board_bss_start; at < board_bss_end; at++) {
        *at = 0;
    }
    for (uint32_t* at = board_data_start; at < board_data_end; at++) {
        *at = board_data_load[at - board_data_start];
    }
    board_exit(main());
}

void board_reset(void) {
    void (*volatile next)(void) = run; // volatile: never inlined in front of the FPU
    enable_fpu();
    next();
}

void board_fault(void) {
    board_print("fault, CFSR ");
    board_print_int(CFSR);
    board_print("\n");
    board_exit(FAULT_EXIT);
}

void board_timer_start(uint32_t rate_Hz) {
    SYST_RVR = BOARD_CLOCK_HZ / rate_Hz - 1U;
    SYST_CVR = 0;
    SYST_CSR = SYST_ENABLE_WITH_INTERRUPT_FROM_CORE_CLOCK;
}

uint32_t board_timer_ticks(void) { return SYST_RVR - SYST_CVR; }
int board_timer_expired(void) { return (SYST_CSR & SYST_COUNTFLAG) != 0U; }

void board_wait(void) { __asm__ volatile("wfi" ::: "memory"); }
void board_interrupt_off(void) { __asm__ volatile("cpsid i" ::: "memory"); }
void board_interrupt_on(void) { __asm__ volatile("cpsie i\n\tisb" ::: "memory"); }
