// For a compiler that comes without a C library: what the core takes of this header (memory.c).
#ifndef SERVOID_BOARD_STRING_H
#define SERVOID_BOARD_STRING_H

#include <stddef.h>

void* memset(void* to, int value, size_t size);
void* memcpy(void* restrict to, const void* restrict from, size_t size);
void* memmove(void* to, const void* from, size_t size);
int memcmp(const void* a, const void* b, size_t size);

#endif
