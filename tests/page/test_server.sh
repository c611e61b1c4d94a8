#!/usr/bin/env bash
# The studio's server over plain HTTP: who is let in, what is refused, how it ends.
. "$(dirname "$0")/support.sh"
python3 "$here/server_over_http.py"
