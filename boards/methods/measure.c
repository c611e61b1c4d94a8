// Runs one method over the same five windows, and counts what it costs: instructions of every
// sample and of the end, stack, and how far J and D are from the truth. Prints one line for each,
// which boards/peers reads.
#include "board.h"
#include "method.h"

#define CALLS 250U
#define PAINT 0xA5A5A5A5U
#define INSTRUCTIONS_PER_TICK (1000000000U / BOARD_CLOCK_HZ)

// ---------------------------------------------------------------- the window

// A rigid axis of system 1: theta = A sin(w t + p) + B exp(-t / tau) - theta(0), and the torque
// that moves it so, J a + D v + w, without Coulomb friction. What is left of the start is the
// exponential.
#define INERTIA_KGM2 0.116e-4
#define VISCOUS_NMS 0.75e-4
#define CONSTANT_NM 0.01
#define RATED_NM 0.637
#define COUNT_RAD (6.28318530717958648 / 131072)
#define AMPLITUDE_RAD 0.05
#define TAU_S 0.1
#define PHASE_COSINE 0.76484218728448843 // of 0.7 rad
#define PHASE_SINE 0.64421768723769105

static int32_t torque[METHOD_COUNT];
static int32_t position[METHOD_COUNT];

typedef struct {
    uint64_t frequency_uHz;
    double start_rad; ///< B
} window_t;
#define WINDOWS 5U
static const window_t windows[WINDOWS] = {
    {62500000U, 0.0}, {62500000U, 0.01}, {50000000U, 0.0}, {50000000U, 0.01}, {20000000U, 0.01}};

// Taylor's series: |x| < 0.1, so that 9 terms are exact.
static double series(double x, int first, double sign) {
    double term = (first == 0) ? 1.0 : x;
    double sum = term;
    for (int k = first + 1; k < 18; k += 2) {
        term *= sign * x * x / (k * (k + 1));
        sum += term;
    }
    return sum;
}

static int32_t down(double x) {
    const int32_t toward_zero = (int32_t)x;
    return toward_zero - ((x < toward_zero) ? 1 : 0);
}

static void make_window(const window_t* window) {
    const double frequency_Hz = (double)window->frequency_uHz / 1000000.0;
    const double omega = 6.28318530717958648 * frequency_Hz;
    const double step = omega / METHOD_RATE_HZ;
    const double decay = series(-1 / TAU_S / METHOD_RATE_HZ, 0, 1.0) +
                         series(-1 / TAU_S / METHOD_RATE_HZ, 1, 1.0); // cosh + sinh
    const double cosine = series(step, 0, -1.0);
    const double sine = series(step, 1, -1.0);
    double c = PHASE_COSINE;
    double s = PHASE_SINE;
    double rest = window->start_rad;
    for (uint32_t k = 0; k < METHOD_COUNT; k++) {
        const double theta = AMPLITUDE_RAD * (s - PHASE_SINE) + rest - window->start_rad;
        const double speed = AMPLITUDE_RAD * omega * c - rest / TAU_S;
        const double acceleration = -AMPLITUDE_RAD * omega * omega * s + rest / TAU_S / TAU_S;
        const double torque_Nm = INERTIA_KGM2 * acceleration + VISCOUS_NMS * speed + CONSTANT_NM;
        position[k] = down(theta / COUNT_RAD);
        torque[k] = down(torque_Nm / RATED_NM * 1048576.0 + 0.5);
        const double next = c * cosine - s * sine;
        s = s * cosine + c * sine;
        c = next;
        rest *= decay;
    }
}

// ---------------------------------------------------------------- cost

static uint32_t saved[128];

__attribute__((noinline)) static void empty(int32_t a, int32_t b) {
    __asm__ volatile("" ::"r"(a), "r"(b));
}

static void copy(uint32_t* to, const uint32_t* from) {
    for (uint32_t i = 0; i < method_state_words; i++) {
        to[i] = from[i];
    }
}

// Until it has taken its reload it says that all of the period is over.
static uint32_t start_timer(void) {
    board_timer_start(2);
    while (board_timer_ticks() > 1000U) {
    }
    return board_timer_ticks();
}

static uint32_t ticks_of_step(void (*step)(int32_t, int32_t), uint32_t k) {
    void (*volatile hidden)(int32_t, int32_t) = step;
    void (*const opaque)(int32_t, int32_t) = hidden;
    const uint32_t before = start_timer();
    for (uint32_t i = 0; i < CALLS; i++) {
        copy(method_state, saved);
        opaque(torque[k], position[k]);
    }
    return board_timer_ticks() - before;
}

// The empty function is its return, which the measured one has too: it is counted back in.
static uint32_t instructions_of_step(uint32_t k) {
    copy(saved, method_state);
    const uint32_t around = ticks_of_step(empty, k);
    const uint32_t ticks = ticks_of_step(method_step, k) - around; // the sample is taken
    return (ticks * INSTRUCTIONS_PER_TICK + CALLS / 2U) / CALLS + 1U;
}

static void feed(void) {
    for (uint32_t k = 0; k < METHOD_COUNT; k++) {
        method_step(torque[k], position[k]);
    }
}

static uint32_t* stack_pointer(void) {
    uint32_t* sp;
    __asm__ volatile("mov %0, sp" : "=r"(sp));
    return sp;
}

static void first_step(void) { method_step(torque[0], position[0]); }

// Lowest word that the call has written, below the stack of this function.
__attribute__((noinline)) static uint32_t stack_of(void (*call)(void)) {
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

static void say(const char* name, int64_t number) {
    board_print(name);
    board_print(" ");
    board_print_int(number);
    board_print("\n");
}

static void measure_cost(void) {
    uint32_t most = 0;
    uint32_t least = UINT32_MAX;
    uint32_t sum = 0;
    method_begin(windows[0].frequency_uHz);
    for (uint32_t k = 0; k < METHOD_COUNT; k++) {
        const uint32_t instructions = instructions_of_step(k);
        most = (instructions > most) ? instructions : most;
        least = (instructions < least) ? instructions : least;
        sum += instructions;
    }
    const uint32_t before = start_timer();
    method_solve();
    const uint32_t end = (board_timer_ticks() - before) * INSTRUCTIONS_PER_TICK;
    say("step_least", least);
    say("step_most", most);
    say("end", end);
    say("total", (int64_t)sum + end);
    method_begin(windows[0].frequency_uHz);
    say("step_stack", stack_of(first_step));
    method_begin(windows[0].frequency_uHz);
    feed();
    say("end_stack", stack_of(method_solve));
}

// ---------------------------------------------------------------- errors

static void print_errors(const method_answer_t* answer) {
    // the same units as SPEC.md's, torque in Q20
    const double per_count = 1048576.0 / RATED_NM * COUNT_RAD * METHOD_RATE_HZ;
    const double inertia = (double)answer->inertia / per_count / METHOD_RATE_HZ;
    const double viscous = (double)answer->viscous / per_count;
    board_print(" J_ppm ");
    board_print_int(down((inertia / INERTIA_KGM2 - 1.0) * 1e6 + 0.5));
    board_print(" D_permille ");
    board_print_int(down((viscous / VISCOUS_NMS - 1.0) * 1e3 + 0.5));
    board_print("\n");
}

int main(void) {
    for (uint32_t i = 0; i < WINDOWS; i++) {
        make_window(&windows[i]);
        method_begin(windows[i].frequency_uHz);
        feed();
        method_solve();
        for (uint32_t a = 0; (a < METHOD_ANSWERS) && (method_answer[a].name != 0); a++) {
            board_print("answer ");
            board_print_int(a);
            print_errors(&method_answer[a]);
        }
    }
    make_window(&windows[0]);
    measure_cost();
    return 0;
}
