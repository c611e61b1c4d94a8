/* A stranger's firmware: links the installed core, calls it, and checks which version it got. */
#include <servoid/sid_osc.h>
#include <servoid/sid_version.h>

#include <string.h>

int main(int argc, char** argv) {
    const uint64_t increment = sid_phase_increment(100U, 8000U); /* 100 Hz at 8 kHz: 1/80 turn */
    const sid_osc_t quarter = sid_osc(increment * 20U);

    if (argc != 2 || strcmp(argv[1], SID_VERSION_STRING) != 0) return 1;
    if (increment != UINT64_C(230584300921369395)) return 2;
    return quarter.sine_q31 > 2147483000 ? 0 : 3;
}
