#!/usr/bin/env bash
# The blocks of the documentation that need measured data: a test of its own, so that a machine without
# them still counts the others as passed.
exec bash "$(dirname "$0")/test_docs.sh" --measured
