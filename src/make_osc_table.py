#!/usr/bin/env python3
"""Writes sid_osc_table.c: 160 entries of sin(2 pi i / 128) in Q31 and the two constants of the series."""
import math

TWO_PI = round(2 * math.pi * 2.0 ** (34 - 39 + 32))
SIXTH = round(2.0 ** (32 - 36 + 32) / 6)
LIMIT = 2**31 - 1
entries = []
for i in range(160):
    entries.append(max(-LIMIT, min(LIMIT, round(math.sin(2 * math.pi * i / 128) * 2.0**31))))

print("// Written by make_osc_table.py; verified against long double by the test of sid_osc.")
print('#include "servoid/sid_osc.h"\n')
print("// clang-format off")
print("const int32_t sid_osc_table[160 + 2] = {")
for i in range(0, len(entries), 7):
    print("    " + ", ".join(str(e) for e in entries[i : i + 7]) + ",")
print(f"    {TWO_PI}, {SIXTH},")
print("};")
print("// clang-format on")
