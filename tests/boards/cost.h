/// What a call costs: instructions and stack, counted on the board.
///
/// Purpose     QEMU runs one instruction a nanosecond, so that ticks of the timer over a thousand
///             equal calls are instructions. Every call begins with the same saved state.
#ifndef SERVOID_TEST_COST_H
#define SERVOID_TEST_COST_H

#include "servoid/servoid.h"

typedef struct {
    const char* name;
    void (*call)(void);
    void (*empty)(void); ///< the same call of a function with the same arguments and nothing in it
    uint32_t* state;     ///< restored before each call
    const uint32_t* saved; ///< to this
    uint32_t words;
    uint32_t fewest; ///< instructions so far
    uint32_t most;
    uint32_t stack; ///< bytes, the most so far
    uint32_t cases;
} cost_t;

/// The corners of what a drive may sample: [0, COST_SAMPLES).
#define COST_SAMPLES 63U
sid_sample_t cost_sample(uint32_t index);
uint32_t cost_random(void);

/// One case: the call with the state as it is now.
void cost_measure(cost_t* cost);
/// Prints it; what is allowed is judged elsewhere (tools/budget).
void cost_report(const cost_t* cost);

/// sid_identify_step in each phase of a session; sid_node_step in each kind of run.
bool cost_of_session(void);
bool cost_of_node(void);
/// Stack of a real interrupt with sid_identify_step in it, the processor's own frame included.
uint32_t cost_of_interrupt(void);

#endif
