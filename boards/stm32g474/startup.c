// Vector table, first instructions, and what becomes of a fault.
#include "stm32g474.h"

extern uint32_t image_stack_high[];
extern uint32_t image_data_start[], image_data_end[], image_data_load[];
extern uint32_t image_bss_start[], image_bss_end[];

int main(void);
void reset(void);
void fault(void);
void ADC1_2_IRQHandler(void);

typedef void (*vector_t)(void);
typedef struct {
    uint32_t* stack;
    vector_t system[15];
    vector_t irq[ADC1_2_IRQ + 1U]; // the last one that is enabled
} vectors_t;

// An entry that is missing is never enabled; were it, the processor takes the fault in its place.
extern const vectors_t vectors;
__attribute__((section(".vectors"), used)) const vectors_t vectors = {
    image_stack_high,
    {reset, fault, fault, fault, fault, fault, 0, 0, 0, 0, fault, fault, 0, fault, fault},
    {[ADC1_2_IRQ] = ADC1_2_IRQHandler}};

static void reset_processor(void) {
    CORTEX_M4("dsb");
    *SCB_AIRCR = SCB_AIRCR_RESET;
    for (;;) {
    }
}

static void run(void) {
    for (uint32_t* at = image_bss_start; at < image_bss_end; at++) {
        *at = 0;
    }
    for (uint32_t* at = image_data_start; at < image_data_end; at++) {
        *at = image_data_load[at - image_data_start];
    }
    (void)main();
    reset_processor();
}

// Before the FPU is on, no instruction of it may run: the compiler likes its registers for copies.
void reset(void) {
    void (*volatile next)(void) = run; // volatile: never inlined in front of the FPU
    *SCB_CPACR |= SCB_CPACR_FPU;
    CORTEX_M4("dsb\n\tisb");
    next();
}

// Also the clock security system's NMI. The power stage goes off and stays so; the watchdog resets.
void fault(void) {
    TIM1->BDTR &= ~TIM_BDTR_MOE;
    for (;;) {
    }
}
