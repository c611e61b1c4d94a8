/// An STM32G474 for tests: its registers are memory, and what the hardware does by itself is done
/// where the port looks.
///
/// Purpose     The port's own code runs on a PC and on an emulated Cortex-M4; the tests read what
/// it
///             wrote, by addresses and bits of RM0440 that they state themselves.
#ifndef SERVOID_FAKE_H
#define SERVOID_FAKE_H

#include "servoid/sid_can.h"

/// All registers 0 but those that matter, which get the values of the reset.
void fake_reset(void);
/// The word at an address.
uint32_t fake_get(uint32_t address);
void fake_set(uint32_t address, uint32_t value);
/// Bits [low, high] of it.
uint32_t fake_bits(uint32_t address, uint32_t high, uint32_t low);

/// Called where the port waits for hardware, before that answers.
extern void (*fake_on_wait)(uint32_t address);
/// The register for which the port waits in vain.
extern uint32_t fake_dead_address;

#define FAKE_ELEMENT 18U
/// A frame arrives in Rx FIFO 0; false if three are waiting.
bool fake_can_arrive(const uint32_t element[FAKE_ELEMENT]);
/// The oldest frame of the Tx FIFO leaves; false if there is none.
bool fake_can_leave(uint32_t element[FAKE_ELEMENT]);

/// An element by the tables of RM0440, written apart from the port's; and a frame of one.
void fake_encode(const sid_can_frame_t* frame, uint32_t element[FAKE_ELEMENT]);
void fake_decode(const uint32_t element[FAKE_ELEMENT], sid_can_frame_t* frame);

/// Counts and tells what is not so. Line by line, so that the tests need no C library.
void expect(bool is_so, const char* what, int64_t value);
extern int fake_failures;

#endif
