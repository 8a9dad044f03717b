#!/bin/bash
# suite.sh BUILD: runs another build's tests, those of the whole checkout left out. What a sanitizer has to say fails
# the program that it concerns.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
export ASAN_OPTIONS=detect_stack_use_after_return=1
export LSAN_OPTIONS=suppressions=$here/lsan.supp:print_suppressions=0
export TSAN_OPTIONS=halt_on_error=1
exec ctest --test-dir "$1" --output-on-failure --parallel "$(nproc)" --label-exclude whole
