#include "plant/session.hpp"

#include "common/error.hpp"
#include "identify/core_window.hpp"
#include "servoid/sid_hal.h"

#include <cmath>

namespace servoid {

namespace {

// What the HAL of the simulated drive stands on: one drive per thread at a time.
struct Port {
    SimulatedDrive* drive = nullptr;
    int32_t reference_q8 = 0;
    int32_t torque_pu_q20 = 0; // held since the last period
};
thread_local Port port;

constexpr int kPollSamples = 64; // replayed per background call

uint64_t micro(double hertz) { return uint64_t(std::llround(hertz * 1e6)); }

uint16_t q8(double periods) { return uint16_t(std::lround(periods * 256)); }

sid_identify_config_t config_of(const SessionOptions& options,
                                const std::vector<sid_frequency_t>& plan,
                                std::vector<sid_result_t>& results) {
    sid_identify_config_t config{};
    config.plan = plan.data(), config.plan_length = uint8_t(plan.size());
    config.results = results.data();
    config.ramp_periods_q8 = q8(options.ramp_periods);
    config.settle_periods_q8 = q8(options.settle_periods);
    config.window_periods_q8 = q8(options.window_periods);
    config.windows = uint8_t(options.windows);
    config.method = options.method;
    config.torque_timing = SID_TORQUE_HELD_LAST;
    return config;
}

SessionResult in_si(const sid_result_t& r, const SimulatedDrive& drive, double frequency_Hz) {
    const double h = drive.sample_time_s(), c = drive.position_per_count();
    const double full = drive.full_torque();
    SessionResult out;
    out.frequency_Hz = frequency_Hz;
    out.inertia = to_double(r.inertia) * full * h * h / c;
    out.viscous = to_double(r.viscous) * full * h / c;
    out.inertia_std = to_double(r.inertia_std) * full * h * h / c;
    out.viscous_std = to_double(r.viscous_std) * full * h / c;
    out.std_known = r.std_known;
    out.position_amplitude = to_double(r.position_amplitude) * c;
    out.torque_amplitude = to_double(r.torque_amplitude) * full;
    out.reason = sid_reason_t(r.reason);
    return out;
}

// One control interrupt: the session through the HAL, then the drive's own loop.
DriveSample interrupt(sid_identify_t& session) {
    sid_sample_t sample;
    sid_command_t command;
    sid_hal_read(&sample);
    sid_identify_step(&session, &sample, &command);
    sid_hal_write_reference(command.reference_q8);
    const DriveSample s = port.drive->step_q8(port.reference_q8);
    port.torque_pu_q20 = s.torque_pu_q20;
    return s;
}

} // namespace

extern "C" {

void sid_hal_read(sid_sample_t* sample) {
    sample->position_raw = uint32_t(port.drive->counts());
    sample->torque_pu_q20 = port.torque_pu_q20;
}

void sid_hal_write_reference(int32_t reference_q8) { port.reference_q8 = reference_q8; }

uint64_t sid_hal_sample_rate_uHz(void) { return micro(1 / port.drive->sample_time_s()); }

void sid_hal_enter_critical(void) {}
void sid_hal_exit_critical(void) {}

} // extern "C"

std::vector<SessionResult> run_session(SimulatedDrive& drive, const std::vector<PlannedSine>& plan,
                                       const SessionOptions& options,
                                       const SessionObserver& observer) {
    port = Port{&drive, 0, 0};
    std::vector<sid_frequency_t> frequencies;
    for (const PlannedSine& sine : plan)
        frequencies.push_back(
            {sid_phase_increment(micro(sine.frequency_Hz), sid_hal_sample_rate_uHz()),
             int32_t(std::lround(sine.amplitude / drive.position_per_count() * 256))});
    std::vector<sid_result_t> results(plan.size());
    const sid_identify_config_t config = config_of(options, frequencies, results);
    sid_identify_t session;
    if (!sid_identify_init(&session, &config) ||
        !sid_identify_start(&session, uint32_t(drive.counts())))
        throw UsageError("the session's plan is out of range: frequency, amplitude or window");
    sid_state_t state = SID_STATE_MEASURING;
    while (state == SID_STATE_MEASURING || state == SID_STATE_STOPPING) {
        const DriveSample s = interrupt(session);
        if (observer) observer(s);
        state = sid_identify_poll(&session, kPollSamples);
    }
    std::vector<SessionResult> out;
    for (size_t i = 0; i < plan.size(); ++i)
        out.push_back(in_si(results[i], drive, plan[i].frequency_Hz));
    return out;
}

} // namespace servoid
