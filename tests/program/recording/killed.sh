#!/bin/bash
# killed.sh FLANEUR: whenever `sim --record` is killed, all but the last second of what it had simulated can be shown.
set -euo pipefail
flaneur=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failed() { echo "FAILED: $*" && cat said && exit 1; }
for _ in {1..20}; do
    rm -f a.flr states
    # How far it has come is told by a log that has as many bytes for each tick.
    "$flaneur" sim --scene corner --walkers 100 --seconds 100000 --record a.flr --state-log - > states 2> said &
    pid=$!
    sleep "$((RANDOM % 3 + 1)).$((RANDOM % 1000))"
    kill -9 $pid
    wait $pid 2> /dev/null || true
    head=$(grep -abm 1 '^$' states | cut -d : -f 1)
    [[ -n $head ]] || continue  # it was still loading
    fields=$(head -c "$head" states | grep -cE '^(walker|crowd) ')
    come=$((($(stat -c %s states) - head - 1) / (8 + 2 * fields + 2 * 100) - 1))
    ((come > 120)) || continue
    "$flaneur" replay a.flr --check > said 2>&1 || failed "after tick $come"
    kept=$(sed -nE 's/.*ticks 0 to ([0-9]+) .*/\1/p' said)
    ((kept + 60 >= come)) || failed "killed after tick $come, and $kept are kept"
    echo "killed after tick $come, $kept are kept"
    looked=1
done
[[ -n ${looked-} ]] || failed "it was never killed under way"
