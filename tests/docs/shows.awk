# Whether a printed block stands in an output: awk -f shows.awk OUTPUT BLOCK
# Both become words, numbers and signs. The block's lines must be found in order, each in one piece;
# those that are not are printed, and the status is 1. Last digits differ between compilers and processors,
# and with them a bar by one character: numbers are compared within 2 % or one of their last digit.

function tokens(text, list, n) {
    while (match(text, /[A-Za-z_][A-Za-z_0-9]*|[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?|#+|[^ \t]/)) {
        list[++n] = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
    }
    return n
}

function last_digit(number,   part) { # 0 for a count
    split(tolower(number), part, "e")
    if (number !~ /[.eE]/) return 0
    return 10 ^ (part[2] - (part[1] ~ /\./ ? length(part[1]) - index(part[1], ".") : 0))
}

function larger(a, b) { return a > b ? a : b }

function same(a, b,   off) {
    if (a == b || (a ~ /^#/ && b ~ /^#/)) return 1
    if (a !~ /^[0-9]/ || b !~ /^[0-9]/) return 0
    off = a - b < 0 ? b - a : a - b
    return off <= 1.001 * larger(0.02 * larger(a, b), larger(last_digit(a), last_digit(b)))
}

function stands_at(start,   i) {
    for (i = 1; i <= wanted_count; i++)
        if (!same(wanted[i], output[start + i])) return 0
    return 1
}

NR == FNR { count = tokens($0, output, count); next }
/^[ \t]*(\.\.\.|…)?[ \t]*$/ { next }
{
    wanted_count = tokens($0, wanted, 0)
    for (start = at; start + wanted_count <= count && !stands_at(start); start++);
    if (start + wanted_count > count) { print; missing = 1 }
    else at = start + wanted_count
}
END { exit missing }
