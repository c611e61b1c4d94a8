#!/usr/bin/env bash
# The reference pages are what docs/write-reference makes of the headers and of the program.
set -euo pipefail
source_dir=$(realpath "${SERVOID_SOURCE_DIR:-$(dirname "$0")/../..}")
"$source_dir/docs/write-reference" "${SERVOID_PROGRAM:?path of the built program}" --check
