// A session on the simulated axis: finds its inertia, prints it. Exit code 0 if it is within 1.5 %.
#include "board.h"
#include "drive.h"

#define MOST_SAMPLES 40000U

static void say(const char* name, int64_t number, const char* unit) {
    board_print(name);
    board_print_int(number);
    board_print(unit);
}

static bool judge(uint32_t i) {
    const sid_result_t* const result = &drive.results[i];
    const int64_t truth_e12 = (int64_t)(drive.axis.inertia_kgm2 * 1e12 + 0.5);
    const int64_t found_e12 = drive_inertia_e12(result);
    const int64_t error_ppm = (found_e12 - truth_e12) * 1000000 / truth_e12;
    say("", (int64_t)i * 50 + 50, " Hz: J ");
    say("", found_e12, "e-12 kg m^2, ");
    say("error ", error_ppm, " ppm, D ");
    say("", drive_viscous_e9(result), "e-9 N m s, ");
    say("windows ", result->windows, ", ");
    board_print(sid_reason_text((sid_reason_t)result->reason));
    board_print("\n");
    return (result->reason == SID_OK) && (error_ppm >= -15000) && (error_ppm <= 15000);
}

int main(void) {
    drive_power_up();
    if (!drive_start()) {
        return 2;
    }
    while ((drive_main_loop() < SID_STATE_DONE) && (drive.samples < MOST_SAMPLES)) {
    }
    bool good = sid_identify_reason(&drive.session) == SID_OK;
    for (uint32_t i = 0; i < DRIVE_PLAN; i++) {
        good = judge(i) && good;
    }
    say("interrupts ", drive.samples, ", ");
    say("late ", drive.late, ", ");
    say("reference ", drive.reference_q8, "\n");
    return (good && (drive.late == 0U) && (drive.reference_q8 == 0)) ? 0 : 1;
}
