// A drive whose hardware fails in the middle of a session: a stuck encoder, a jump, a torque at its
// limit, an axis that runs away, interrupts that are missed. Each ends with its reason, and with
// the reference at rest.
// Missed interrupts are no time to the core: it sees them where the axis has moved too far
// meanwhile, and else in the residual only.
#include "board.h"
#include "drive.h"

// Samples in the second window of 50 Hz: fast, and before a turn.
#define FAULT_AT 2060U
#define TURN_AT 2080U
#define MOST_SAMPLES 20000U

// ---------------------------------------------------------------- what goes wrong

static uint32_t last_raw;

static void stuck_encoder(sid_sample_t* sample, uint32_t index) {
    if (index < FAULT_AT) {
        last_raw = sample->position_raw;
    }
    sample->position_raw = last_raw;
}
static void jump(sid_sample_t* sample, uint32_t index) {
    sample->position_raw += (index == FAULT_AT) ? 40000U : 0U;
}
static void encoder_noise(sid_sample_t* sample, uint32_t index) {
    sample->position_raw += (index >= FAULT_AT) ? index * 2654435761U : 0U;
}
static void saturated_torque(sid_sample_t* sample, uint32_t index) {
    (void)index;
    sample->torque_pu_q20 = sid_clamp(sample->torque_pu_q20, -100000, 100000);
}
static void torque_spike(sid_sample_t* sample, uint32_t index) {
    sample->torque_pu_q20 = (index == FAULT_AT) ? INT32_MIN : sample->torque_pu_q20;
}
static void reversed_encoder(sid_sample_t* sample, uint32_t index) {
    (void)index;
    sample->position_raw = 0U - sample->position_raw;
}
static void torque_is_not_read(sid_sample_t* sample, uint32_t index) {
    (void)index;
    sample->torque_pu_q20 = 0;
}

// The axis goes on while the interrupt is kept out, with the torque of the last one.
static void miss_interrupts(uint32_t samples) {
    if (samples == 0U) {
        return;
    }
    board_interrupt_off();
    (void)board_timer_expired();
    for (uint32_t i = 0; i < samples; i++) {
        while (!board_timer_expired()) {
        }
        drive_move_axis();
    }
    board_interrupt_on();
}
static void one_missed(uint32_t index) { miss_interrupts((index == FAULT_AT) ? 1 : 0); }
static void many_missed(uint32_t index) { miss_interrupts((index == FAULT_AT) ? 40 : 0); }
static void many_missed_at_a_turn(uint32_t index) { miss_interrupts((index == TURN_AT) ? 40 : 0); }

// ---------------------------------------------------------------- cases

typedef struct {
    const char* name;
    void (*fault)(sid_sample_t* sample, uint32_t index);
    void (*stall)(uint32_t index);
    int32_t stroke_limit;
    int32_t torque_limit;
    int32_t saturation;
    uint32_t stuck_limit;
    sid_reason_t reason;
    bool is_one_encoder;   ///< the drive's loop has the session's
    int32_t residual_from; ///< of position, 1/256 count
    int32_t residual_to;
} case_t;

// Four times rated torque for a sample: some 45 samples of what this axis takes at 50 Hz. The
// default is ten times as much, and may come only after the leg.
#define STUCK_LIMIT (4U << 20)

#define ANY 0, INT32_MAX
static const case_t cases[] = {
    {"nothing", 0, 0, 0, 0, 0, 0, SID_OK, false, 900, 1200},
    {"stuck encoder", stuck_encoder, 0, 0, 0, 0, STUCK_LIMIT, SID_ENCODER_STUCK, false, ANY},
    {"stuck encoder, default limit", stuck_encoder, 0, 0, 0, 0, 0, SID_ENCODER_STUCK, false, ANY},
    {"stuck encoder of the loop too", stuck_encoder, 0, 0, 0, 0, STUCK_LIMIT, SID_ENCODER_STUCK,
     true, ANY},
    {"jump", jump, 0, 0, 0, 0, 0, SID_ENCODER_JUMP, false, ANY},
    {"noise for an encoder", encoder_noise, 0, 0, 0, 0, 0, SID_ENCODER_JUMP, false, ANY},
    {"saturated torque", saturated_torque, 0, 0, 0, 100000, 0, SID_SATURATED, false, ANY},
    {"torque spike", torque_spike, 0, 0, 1 << 20, 0, 0, SID_ABORTED_TORQUE, false, ANY},
    {"stroke", 0, 0, 2000, 0, 0, 0, SID_ABORTED_STROKE, false, ANY},
    {"encoder reversed", reversed_encoder, 0, 0, 0, 0, 0, SID_NEGATIVE_INERTIA, false, ANY},
    {"torque is not read", torque_is_not_read, 0, 0, 0, 0, 0, SID_NO_EXCITATION, false, ANY},
    {"1 interrupt missed", 0, one_missed, 0, 0, 0, 0, SID_OK, false, 2000, 4000},
    {"40 interrupts missed", 0, many_missed, 0, 0, 0, 0, SID_ENCODER_JUMP, false, ANY},
    {"40 missed at a turn", 0, many_missed_at_a_turn, 0, 0, 0, 0, SID_NOT_A_SINE, false, 30000,
     INT32_MAX}};

static void set_up(const case_t* c) {
    drive_power_up();
    drive.fault = c->fault;
    drive.stall = c->stall;
    drive.is_one_encoder = c->is_one_encoder;
    drive.config.stroke_limit_count = c->stroke_limit;
    drive.config.torque_limit_pu_q20 = c->torque_limit;
    drive.config.torque_saturation_pu_q20 = c->saturation;
    drive.config.stuck_limit_pu_q20 = c->stuck_limit;
    drive.config.step_limit_count = 2000;
}

// The reference does not move, nor does the axis by more than a count a sample; except where the
// loop does not see it.
static bool is_at_rest(void) {
    const int32_t reference_q8 = drive.reference_q8;
    bool rests = true;
    for (uint32_t i = 0; i < 2000U; i++) {
        const int32_t before = drive.position_count;
        (void)drive_main_loop();
        const int32_t moved = drive.position_count - before;
        rests = rests && (drive.reference_q8 == reference_q8);
        rests = rests && ((i < 1000U) || drive.is_one_encoder || ((moved <= 1) && (moved >= -1)));
    }
    return rests;
}

static void say(const char* before, int64_t number) {
    board_print(before);
    board_print_int(number);
}

static uint32_t aborts(void) {
    const sid_counters_t* const c = &drive.session.counters;
    return c->torque_aborts + c->stroke_aborts + c->encoder_jumps + c->encoder_stuck +
           c->user_aborts;
}

// Reasons that a guard gives, with a counter of its own.
static bool is_guard(sid_reason_t reason) {
    return (reason == SID_ENCODER_STUCK) || (reason == SID_ENCODER_JUMP) ||
           (reason == SID_ABORTED_TORQUE) || (reason == SID_ABORTED_STROKE);
}

static bool run(const case_t* c) {
    const sid_result_t* const result = &drive.results[0];
    set_up(c);
    bool good = drive_start();
    sid_state_t state = SID_STATE_MEASURING;
    while ((state < SID_STATE_DONE) && (drive.samples < MOST_SAMPLES)) {
        state = drive_main_loop();
    }
    const uint32_t ended = drive.samples;
    const bool rests = is_at_rest();
    const sid_reason_t reason = sid_identify_reason(&drive.session);
    const int32_t residual = sid_scaled_to_fixed(result->position_residual, 8);
    good = good && rests && (reason == c->reason) && (residual >= c->residual_from) &&
           (residual <= c->residual_to) && (aborts() == (is_guard(c->reason) ? 1U : 0U));
    board_print(c->name);
    board_print(": ");
    board_print(sid_reason_text(reason));
    say(" after ", ended);
    say(" samples, J ", drive_inertia_e12(result));
    say("e-12 kg m^2, residual ", residual);
    say("/256 counts, aborts ", aborts());
    board_print(", of the first leg ");
    board_print(sid_reason_text((sid_reason_t)result->reason));
    board_print(rests ? ", at rest" : ", NOT at rest");
    board_print(good ? "\n" : ": WRONG\n");
    return good;
}

int main(void) {
    bool good = true;
    for (uint32_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        good = run(&cases[i]) && good;
    }
    return good ? 0 : 1;
}
