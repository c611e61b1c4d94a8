#!/usr/bin/env bash
# Flash and RAM of the core on every board are what boards/README.md says.
. "$(dirname "$0")/support.sh"
"$root/boards/sizes" >sizes.txt
[ "$(wc -l <sizes.txt)" -ge 20 ] || fail "few sizes: $(cat sizes.txt)"
while IFS= read -r line; do
    grep -qxF -- "$line" "$root/boards/README.md" || fail "not in boards/README.md: $line"
done <sizes.txt
sed -n '3,4s/^| \(.*\) |$/figure: boards (M4 | M7 | M33 | M55 | RV32IMAC): \1 bytes/p' sizes.txt
