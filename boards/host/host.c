// A PC as a board: the same programs, the interrupt comes when the program waits for it.
#include "board.h"

#include <stdio.h>
#include <stdlib.h>

void board_print(const char* text) { (void)fputs(text, stdout); }
void board_exit(int status) { exit(status); }

static int is_timer_on;
void board_timer_start(uint32_t rate_Hz) { is_timer_on = rate_Hz != 0U; }
__attribute__((weak)) void board_timer_interrupt(void) {}
void board_wait(void) {
    if (is_timer_on) {
        board_timer_interrupt();
    }
}
void board_interrupt_off(void) {}
void board_interrupt_on(void) {}
