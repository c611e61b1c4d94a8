# Whether every row of telemetry in a candump log carries the reference that was asked for, in Q8
# counts. Reads the capture of a simulation of the same move, then the log.
# Decoded here once more from SPEC.md's tables, apart from the program.
function number(hex, at, bytes,    i, out) { # little-endian
    out = 0
    for (i = bytes - 1; i >= 0; --i)
        out = out * 256 + (index(digits, substr(hex, 2 * (at + i) + 1, 1)) - 1) * 16 + \
              index(digits, substr(hex, 2 * (at + i) + 2, 1)) - 1
    return out
}
function integer(hex, at,    u) { u = number(hex, at, 4); return u < 2147483648 ? u : u - 4294967296 }
function q8(rad,    x) { x = rad / unit; return x < 0 ? -int(-x + 0.5) : int(x + 0.5) }
BEGIN { digits = "0123456789ABCDEF"; FS = "," }
/^#/ { next }
FNR == NR && !column {
    for (i = 1; i <= NF; ++i) if ($i == "position_ref_rad") column = i
    if (!column) { print "no position_ref_rad"; failed = 1; exit }
    next
}
FNR == NR { asked[count++] = $column; next }
{ split($0, word, " "); if (word[3] !~ /^481##/) next; hex = substr(word[3], 7) }
# A description begins a run, and says where. Frames that were cut short say nothing.
number(hex, 0, 1) == 2 && length(hex) == 96 && number(hex, 32, 4) > 0 {
    start = number(hex, 32, 4)
    exponent = number(hex, 22, 2); if (exponent > 32767) exponent -= 65536
    unit = integer(hex, 24) * 2 ^ (exponent - 8)
}
number(hex, 0, 1) == 1 && length(hex) == 128 {
    rows = number(hex, 1, 1); tick = number(hex, 4, 4)
    for (r = 0; r < rows; ++r) {
        k = tick + r; if (k in heard) continue
        heard[k] = integer(hex, 8 + 11 * r + 4)
    }
}
END {
    if (failed) exit 1
    for (k in heard) {
        n = k - start; if (n < 0) continue
        if (n >= count) n = count - 1 # the last one stays
        ++seen
        if (heard[k] != q8(asked[n]) && ++wrong < 4)
            print "sample " n ": " heard[k] " for " q8(asked[n])
    }
    print seen + 0 " rows, " wrong + 0 " wrong"
    exit wrong > 0 || seen == 0
}
