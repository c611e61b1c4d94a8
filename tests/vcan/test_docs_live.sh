#!/usr/bin/env bash
# The blocks of the documentation that want a bus.
exec bash "$(dirname "$0")/../docs/test_docs.sh" --live
