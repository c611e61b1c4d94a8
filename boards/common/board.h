/// What a program on a board stands on: text out, an exit code, one timer interrupt.
///
/// Purpose     Lets the programs here run on every board and, the same source, on a PC. Nothing of
///             the core needs it: a drive has its own start-up and its own timer.
/// Memory      A stack of at least 16 KiB between board_stack_low and board_stack_high.
#ifndef SERVOID_BOARD_H
#define SERVOID_BOARD_H

#include <stdint.h>

/// Text to whoever runs the board: semihosting, stdout on a PC.
void board_print(const char* text);
/// value in decimal.
void board_print_int(int64_t value);
/// Ends the program with this exit code, 0..255.
void board_exit(int status);

/// From here on board_timer_interrupt comes rate_Hz times a second, once board_interrupt_on() was
/// called.
void board_timer_start(uint32_t rate_Hz);
/// By the program; empty where it has none.
void board_timer_interrupt(void);
/// Sleeps until an interrupt has come. On a PC this is where it comes.
void board_wait(void);
/// Keep the interrupt out and let it in again; what came meanwhile comes once.
void board_interrupt_off(void);
void board_interrupt_on(void);

/// Ticks of BOARD_CLOCK_HZ since the timer was started or its period began, for measuring. Not on a
/// PC.
uint32_t board_timer_ticks(void);
/// A period has ended since the last call: for who has the interrupt off. Cortex-M only.
int board_timer_expired(void);

extern uint32_t board_stack_low[];
extern uint32_t board_stack_high[];

/// The program.
int main(void);

#endif
