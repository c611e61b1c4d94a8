// Numbers as text without a C library.
#include "board.h"

void board_print_int(int64_t value) {
    char text[24];
    char* at = &text[23];
    uint64_t rest = (value < 0) ? 0U - (uint64_t)value : (uint64_t)value;
    *at = '\0';
    do {
        *--at = (char)('0' + (int)(rest % 10U));
        rest /= 10U;
    } while (rest != 0U);
    if (value < 0) {
        *--at = '-';
    }
    board_print(at);
}
