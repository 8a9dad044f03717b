#!/bin/bash
# suite.sh FLANEUR BUILD LEAVES_OUT [PATTERN [CASES]]: runs another build's tests, or those whose names begin as the regular
# expression PATTERN says, and of programs of cases those that CASES takes, as GoogleTest writes filters. Left out are those that concern the whole checkout, and those that a line of the file LEAVES_OUT begins. What a
# sanitizer has to say fails the program that it concerns. The cases of a program run in one process for each core, as a
# process of its own for each takes longer than most cases do. People are made once, by FLANEUR, which a sanitizer would
# take minutes for.
set -euo pipefail
flaneur=$1 build=$2 leaves_out=$3 pattern=${4-.} cases=${5-*}
fresh=$(dirname "$(realpath "$0")")/../fresh
# Of each test "number name".
all=$(ctest --show-only --test-dir "$build" --label-exclude whole | sed -n 's/^ *Test *#\([0-9]*\): /\1 /p' | grep -E " $pattern")
lines=$(sed '/^#/d; s/[.]/[.]/g; s/^/^[0-9]* /' "$leaves_out")
while read -r line; do
    if ! grep --quiet "$line" <<< "$all"; then
        echo "FAILED: no test begins as a line of $leaves_out does: $line" >&2
        exit 1
    fi
done <<< "$lines"
chosen=$(grep --invert-match --file=<(echo "$lines") <<< "$all")
echo "$(wc -l <<< "$chosen") tests of $(wc -l <<< "$all")"

export FLANEUR_WARM_CACHE=$XDG_CACHE_HOME
"$flaneur" sim --scene corner --seconds 0 --hash
export ASAN_OPTIONS=detect_stack_use_after_return=1
export TSAN_OPTIONS=halt_on_error=1
shards=$(nproc)
export GTEST_BRIEF=1
failed=()
for program in $(sed -n 's/^[0-9]* \([a-z_]*_tests\)[.].*/\1/p' <<< "$chosen" | sort -u); do
    without=$(sed -n "s/^${program}[.]\(.*\)/\1*/p" "$leaves_out" | paste --serial --delimiters=:)
    running=()
    for ((shard = 0; shard < shards; ++shard)); do
        GTEST_TOTAL_SHARDS=$shards GTEST_SHARD_INDEX=$shard "$fresh" "$build/$program" --gtest_filter="$cases-$without" &
        running+=($!)
    done
    for pid in "${running[@]}"; do wait "$pid" || failed+=("$program"); done
    echo "$program: $SECONDS s"
done
scripts=$(grep -vE ' [a-z_]*_tests[.]' <<< "$chosen" | cut --delimiter=' ' --fields=1 | paste --serial --delimiters=,) || true
if [[ -n $scripts ]]; then
    ctest --test-dir "$build" --tests-information "0,0,0,$scripts" --output-on-failure --parallel "$(nproc)" ||
        failed+=(scripts)
fi
if ((${#failed[@]})); then echo "FAILED: ${failed[*]}" >&2 && exit 1; fi
