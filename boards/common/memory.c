// The four functions that compilers call by themselves, so that no C library is linked.
#include <stddef.h>
#include <string.h>

// Or the loop in memset would be recognised as a memset, and call itself.
#pragma GCC optimize("no-tree-loop-distribute-patterns")

void* memset(void* to, int value, size_t size) {
    unsigned char* const bytes = to;
    for (size_t i = 0; i < size; i++) {
        bytes[i] = (unsigned char)value;
    }
    return to;
}

void* memcpy(void* restrict to, const void* restrict from, size_t size) {
    unsigned char* const bytes = to;
    const unsigned char* const source = from;
    for (size_t i = 0; i < size; i++) {
        bytes[i] = source[i];
    }
    return to;
}

void* memmove(void* to, const void* from, size_t size) {
    unsigned char* const bytes = to;
    const unsigned char* const source = from;
    for (size_t i = 0; i < size; i++) {
        const size_t k = (bytes < source) ? i : size - 1U - i;
        bytes[k] = source[k];
    }
    return to;
}

int memcmp(const void* a, const void* b, size_t size) {
    const unsigned char* const left = a;
    const unsigned char* const right = b;
    for (size_t i = 0; i < size; i++) {
        if (left[i] != right[i]) {
            return (left[i] < right[i]) ? -1 : 1;
        }
    }
    return 0;
}
