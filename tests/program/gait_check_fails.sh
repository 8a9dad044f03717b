#!/bin/bash
# gait_check_fails.sh FLANEUR: --check fails where a bar is missed, says which and how many, and writes what was asked for.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
status=0
"$1" gait --stairs up --riser 0.25 --tread 0.2 --check --csv walk.csv > table 2> said || status=$?
cat table said
((status == 1))
missed=$(grep --count 'FAIL' table)
((missed > 0))
grep --quiet -E '^  swing_penetration\.mm +[0-9.]+ +<= 5 +FAIL' table
grep --quiet -E '^  speed\.m_s +[0-9.]+ +0\.45 \.\. 0\.65 +pass' table
grep --quiet "^flaneur: $missed of 11 bars are not met" said
[[ -s walk.csv ]]
