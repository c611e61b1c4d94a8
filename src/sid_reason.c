// Apart from sid_inertia.c, so that a drive that prints no text carries none.
#include "servoid/sid_inertia.h"

const char* sid_reason_text(sid_reason_t reason) {
    static const char* const text[SID_REASON_COUNT] = {"not run",          "ok",
                                                       "no excitation",    "torque saturated",
                                                       "window too short", "stroke clipped",
                                                       "overflow",         "ill-conditioned",
                                                       "negative inertia", "not a sine",
                                                       "aborted: stroke",  "aborted: torque",
                                                       "aborted by user",  "encoder stuck",
                                                       "encoder jump",     "master lost",
                                                       "reference starved"};
    return ((unsigned)reason < (unsigned)SID_REASON_COUNT) ? text[reason] : "unknown";
}
