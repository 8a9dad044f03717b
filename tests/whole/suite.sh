#!/bin/bash
# suite.sh FLANEUR BUILD LEAVES_OUT WORDS...: runs another build's tests, those that concern the whole checkout left out
# and those that the lines of the file LEAVES_OUT begin; WORDS go to CTest. What a sanitizer has to say fails the program
# that it concerns. People are made once, by FLANEUR, which a sanitizer would take minutes for.
set -euo pipefail
leaves_out=$(sed '/^#/d' "$3" | paste --serial --delimiters='|' | sed 's/[.]/[.]/g; s/^/^(/; s/$/)/')
words=(--test-dir "$2" --label-exclude whole --exclude-regex "$leaves_out" "${@:4}")
all=$(ctest --show-only --test-dir "$2" --label-exclude whole "${@:4}" | sed -n 's/^Total Tests: //p')
fewer=$(ctest --show-only "${words[@]}" | sed -n 's/^Total Tests: //p')
if [[ $fewer -ge $all ]]; then
    echo "FAILED: $3 leaves none of $all tests out" >&2
    exit 1
fi
export FLANEUR_WARM_CACHE=$XDG_CACHE_HOME
"$1" sim --scene corner --seconds 0 --hash
export ASAN_OPTIONS=detect_stack_use_after_return=1
export TSAN_OPTIONS=halt_on_error=1
ctest "${words[@]}" --output-on-failure --parallel "$(nproc)"
