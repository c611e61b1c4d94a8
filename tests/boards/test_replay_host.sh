#!/usr/bin/env bash
# All sums and results of 13 sessions and of each module at its limits are the same bits with gcc and clang at each level of
# optimisation, and none of it is undefined.
. "$(dirname "$0")/replay.sh"
for CC in gcc clang; do
    export CC
    for level in -O0 -O1 -O2 -O3 -Os; do replays host "$level"; done
done
CC=gcc replays host -O1 -fsanitize=undefined -fno-sanitize-recover=all
