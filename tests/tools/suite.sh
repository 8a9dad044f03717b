#!/bin/bash
# suite.sh BUILD WORDS...: runs another build's tests, those of the whole checkout left out; WORDS go to CTest. What a
# sanitizer has to say fails the program that it concerns.
set -euo pipefail
export ASAN_OPTIONS=detect_stack_use_after_return=1
export TSAN_OPTIONS=halt_on_error=1
exec ctest --test-dir "$1" --output-on-failure --parallel "$(nproc)" --label-exclude whole "${@:2}"
