# What the scripts of this folder have in common: Debian's python3-selenium drives Debian's Chromium.
set -euo pipefail
export LC_ALL=C.UTF-8 PYTHONDONTWRITEBYTECODE=1
here=$(realpath "${SERVOID_SOURCE_DIR:?path of the source}")/tests/page

# Debian's packages are for /usr/bin/python3, whichever comes first.
in_browser() { # SCRIPT
    local python
    for python in python3 /usr/bin/python3; do
        "$python" -c 'import selenium' 2>/dev/null || continue
        "$python" "$here/$1"
        return
    done
    echo "no python3 here has selenium (Debian: python3-selenium, chromium, chromium-driver)"
    exit 1
}
