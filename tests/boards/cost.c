#include "cost.h"

#include "board.h"

#define CALLS 1000U
#define PAINT 0xA5A5A5A5U

sid_sample_t cost_sample(uint32_t index) {
    static const int32_t torque[9] = {0,       1,        -1,        1 << 20,  -(1 << 20),
                                      8388607, -8388608, INT32_MAX, INT32_MIN};
    static const uint32_t position[7] = {0,           1,     0xFFFFFFFFU, 0x7FFFFFFFU,
                                         0x80000000U, 12345, 0xFFFF0000U};
    sid_sample_t sample;
    sample.torque_pu_q20 = torque[index % 9U];
    sample.position_raw = position[index / 9U];
    return sample;
}

uint32_t cost_random(void) {
    static uint32_t state = 2463534242U;
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

// ---------------------------------------------------------------- instructions

static void restore(const cost_t* cost) {
    for (uint32_t i = 0; i < cost->words; i++) {
        cost->state[i] = cost->saved[i];
    }
}

__attribute__((noinline)) static uint32_t ticks_of(const cost_t* cost, void (*call)(void)) {
    void (*volatile hidden)(void) = call; // or the compiler would look into it
    void (*const opaque)(void) = hidden;
    board_timer_start(2);
    const uint32_t before = board_timer_ticks();
    for (uint32_t i = 0; i < CALLS; i++) {
        restore(cost);
        opaque();
    }
    return board_timer_ticks() - before;
}

// The empty function is its return, which the measured one has too: it is counted back in.
static uint32_t instructions_of(const cost_t* cost) {
    const uint32_t ticks = ticks_of(cost, cost->call) - ticks_of(cost, cost->empty);
    const uint64_t nanoseconds = (uint64_t)ticks * 1000000000U / BOARD_CLOCK_HZ;
    return (uint32_t)((nanoseconds + CALLS / 2U) / CALLS) + 1U;
}

// ---------------------------------------------------------------- stack

static uint32_t* stack_pointer(void) {
    uint32_t* sp;
#if defined(__arm__)
    __asm__ volatile("mov %0, sp" : "=r"(sp));
#else
    __asm__ volatile("mv %0, sp" : "=r"(sp));
#endif
    return sp;
}

// Lowest word that the call has written, below the stack of this function.
__attribute__((noinline)) static uint32_t painted_stack_of(void (*call)(void)) {
    uint32_t* const top = stack_pointer();
    volatile uint32_t* at = board_stack_low;
    for (; at < top; at++) {
        *at = PAINT;
    }
    call();
    for (at = board_stack_low; (at < top) && (*at == PAINT); at++) {
    }
    return (uint32_t)((uintptr_t)top - (uintptr_t)at);
}

// ---------------------------------------------------------------- cases

void cost_measure(cost_t* cost) {
    const uint32_t instructions = instructions_of(cost);
    restore(cost);
    const uint32_t stack = painted_stack_of(cost->call);
    restore(cost);
    cost->fewest =
        ((cost->cases == 0U) || (instructions < cost->fewest)) ? instructions : cost->fewest;
    cost->most = (instructions > cost->most) ? instructions : cost->most;
    cost->stack = (stack > cost->stack) ? stack : cost->stack;
    cost->cases++;
}

static void say(const char* before, uint32_t number, const char* after) {
    board_print(before);
    board_print_int(number);
    board_print(after);
}

void cost_report(const cost_t* cost) {
    board_print(cost->name);
    say(": ", cost->fewest, "");
    say("..", cost->most, " instructions in ");
    say("", cost->cases, " cases of 1000 calls, ");
    say("stack ", cost->stack, " bytes\n");
}

// ---------------------------------------------------------------- a real interrupt

static volatile uint32_t interrupts;
static sid_identify_t idle;
static sid_command_t command;

void board_timer_interrupt(void) {
    const sid_sample_t sample = {0, 0};
    sid_identify_step(&idle, &sample, &command);
    interrupts = interrupts + 1U;
}

static void wait_for_interrupt(void) {
    board_timer_start(8000);
    board_interrupt_on();
    while (interrupts == 0U) {
    }
    board_interrupt_off();
}

uint32_t cost_of_interrupt(void) {
    static volatile float used = 1.0F; // an FPU in use makes the processor keep room for it
    used = used + used;
    return painted_stack_of(wait_for_interrupt);
}

int main(void) {
    board_interrupt_off();
    bool good = cost_of_session();
    good = cost_of_node() && good;
    say("interrupt: stack ", cost_of_interrupt(), " bytes, the processor's own frame included\n");
    return good ? 0 : 1;
}
