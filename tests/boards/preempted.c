// A session that is polled all the time, so that interrupts fall into the middle of polls: the
// results are as good, though not the same to the last digit. Prints how often that happened.
#include "board.h"
#include "drive.h"

// A solution that begins late in the time between two interrupts outlasts it: one for each window.
#define MOST_LATE 4U

static volatile int is_in_poll;
static volatile int64_t interrupted;

static void look(sid_sample_t* sample, uint32_t index) {
    (void)sample;
    (void)index;
    interrupted += is_in_poll;
}

static sid_state_t poll(void) {
    is_in_poll = 1;
    const sid_state_t state = sid_identify_poll(&drive.session, 64);
    is_in_poll = 0;
    return state;
}

int main(void) {
    sid_state_t state = SID_STATE_MEASURING;
    drive_power_up();
    drive.fault = look;
    if (!drive_start()) {
        return 2;
    }
    while ((state < SID_STATE_DONE) && (drive.samples < 40000U)) {
        while (drive.samples == drive.moved) {
            state = poll();
        }
        drive_move_axis();
        drive.moved++;
    }
    bool good = (sid_identify_reason(&drive.session) == SID_OK) && (drive.late <= MOST_LATE);
    for (uint32_t i = 0; i < DRIVE_PLAN; i++) {
        const int64_t error_e12 = drive_inertia_e12(&drive.results[i]) - 11600000;
        good = good && (error_e12 < 174000) && (error_e12 > -174000); // 1.5 %
        board_print("J ");
        board_print_int(error_e12 + 11600000);
        board_print("e-12 kg m^2, ");
    }
    board_print_int(interrupted);
    board_print(" polls interrupted, late ");
    board_print_int(drive.late);
    board_print("\n");
    return (good && (interrupted > 1000)) ? 0 : 1;
}
