// An empty port: copy this folder, replace every line marked PORT. It compiles and does nothing.
#include "servoid/servoid.h"

// ---------------------------------------------------------------- the five functions

void sid_hal_read(sid_sample_t* sample) {
    sample->position_raw = 0;  // PORT: the encoder's counter register
    sample->torque_pu_q20 = 0; // PORT: torque reference * 2^20 / rated torque
}

void sid_hal_write_reference(int32_t reference_q8) {
    (void)reference_q8; // PORT: add reference_q8 / 256 counts to the position reference
}

uint64_t sid_hal_sample_rate_uHz(void) {
    return 8000000000U; // PORT: 8 kHz
}

void sid_hal_enter_critical(void) {} // PORT: only if the main loop can preempt the interrupt
void sid_hal_exit_critical(void) {}

// ---------------------------------------------------------------- the two calls

static sid_identify_t session;
static sid_frequency_t plan[2];
static sid_result_t results[2];
static sid_identify_config_t config;

// PORT: the name of the control interrupt in the vector table
void blank_control_interrupt(void);
void blank_control_interrupt(void) {
    sid_sample_t sample;
    sid_command_t command;
    sid_hal_read(&sample);
    sid_identify_step(&session, &sample, &command);
    sid_hal_write_reference(command.reference_q8);
}

static bool begin(void) {
    plan[0].increment_q64 = sid_phase_increment(50000000U, sid_hal_sample_rate_uHz()); // 50 Hz
    plan[0].amplitude_q8 = 2000 * 256;                                                 // PORT
    plan[1].increment_q64 = sid_phase_increment(100000000U, sid_hal_sample_rate_uHz());
    plan[1].amplitude_q8 = 2000 * 256; // PORT
    config.plan = plan;
    config.results = results;
    config.plan_length = 2;
    config.position_bits = 16;            // PORT
    config.stroke_limit_count = 5000;     // PORT
    config.torque_limit_pu_q20 = 1 << 20; // PORT: rated torque
    config.torque_timing = SID_TORQUE_HELD_LAST;
    return sid_identify_init(&session, &config);
}

int main(void) {
    sid_sample_t sample;
    bool good = begin();
    // PORT: start the timer of the control interrupt here
    sid_hal_read(&sample);
    good = good && sid_identify_start(&session, sample.position_raw);
    while (good && (sid_identify_poll(&session, 64) < SID_STATE_DONE)) {
        // PORT: the rest of the main loop
        blank_control_interrupt(); // PORT: remove; the timer does this
    }
    // results[0].inertia is in rated torque per (count / sample^2); see sid_inertia.h for kg m^2
    return (sid_identify_reason(&session) == SID_OK) ? 0 : 1;
}
