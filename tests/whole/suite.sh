#!/bin/bash
# suite.sh FLANEUR BUILD WORDS...: runs another build's tests, those that concern the whole checkout left out; WORDS go to
# CTest. What a sanitizer has to say fails the program that it concerns. People are made once, by FLANEUR,
# which a sanitizer would take minutes for.
set -euo pipefail
export FLANEUR_WARM_CACHE=$XDG_CACHE_HOME
"$1" sim --scene corner --seconds 0 --hash
export ASAN_OPTIONS=detect_stack_use_after_return=1
export TSAN_OPTIONS=halt_on_error=1
ctest --test-dir "$2" --output-on-failure --parallel "$(nproc)" --label-exclude whole "${@:3}"
