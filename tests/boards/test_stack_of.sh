#!/usr/bin/env bash
# The stack of a call graph is the sum along its deepest path, through other files; what has no
# greatest stack is refused with its reason.
. "$(dirname "$0")/support.sh"

cat >one.c <<'END'
int other(int x);
__attribute__((noinline)) static int leaf(int x) { volatile int room[64]; room[x] = x; return room[0]; }
int small(int x) { volatile int y = x; return leaf(y) + 1; }
int deep(int x) { volatile int y = x; return leaf(y) + other(y); }
int recursive(int x) { volatile int y = x; return y ? recursive(y - 1) + y : 0; }
int second(int x);
int first(int x) { volatile int y = x; return y ? second(y) + 1 : 0; }
int (*pointer)(int);
int indirect(int x) { return pointer(x) + 1; }
int dynamic(int n) { volatile int room[n]; room[n - 1] = n; return room[0]; }
int missing(int x);
int calls_missing(int x) { return missing(x) + 1; }
END
cat >two.c <<'END'
int first(int x);
int second(int x) { volatile int y = x; return first(y) + 1; }
int other(int x) { volatile int room[200]; room[x] = x; return room[1]; }
END
for name in one two; do
    arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -O2 -fcallgraph-info=su -c "$name.c" -o "$name.o"
done

bytes() { "$root/tools/stack-of" "$1" one.ci two.ci | sed 's/ .*//'; } # FUNCTION
leaf=$(bytes leaf) other=$(bytes other) small=$(bytes small) deep=$(bytes deep)
((leaf >= 256 && other >= 800)) || fail "leaf $leaf, other $other"
((small > leaf && small < leaf + 64)) || fail "small $small with leaf $leaf"
((deep > other && deep < other + 64)) || fail "deep $deep with other $other"

refused() { # FUNCTION REASON
    local said
    if said=$("$root/tools/stack-of" "$1" one.ci two.ci 2>&1); then fail "$1 has a stack: $said"; fi
    [[ $said == *"$2"* ]] || fail "$1: not for '$2': $said"
}
refused recursive 'recursion: recursive > recursive'
refused first 'recursion: first > second > first'
refused indirect 'call through a pointer in indirect'
refused dynamic 'stack of dynamic is dynamic'
refused calls_missing 'missing is in none of the files'
refused nowhere 'no function is called nowhere'
