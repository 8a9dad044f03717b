#!/bin/bash
# gait_debts.sh FLANEUR SEX AGE: the bars of `flaneur gait --check` that somebody else than the middle man misses are owed,
# and said to be. Everybody meets four in five.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
status=0
"$1" gait --sex "$2" --age "$3" --check --json "$folder/walks.json" > "$folder/table" || status=$?
python3 - "$folder/walks.json" "$2 of $3" "$status" << 'END'
import json, sys
path, who, status = sys.argv[1:]
met = missed = 0
for trial in json.load(open(path))["trials"]:
    for quantity in trial["quantities"]:
        if "pass" not in quantity:
            continue
        met += quantity["pass"]
        missed += not quantity["pass"]
        if not quantity["pass"]:
            goal = f"{quantity.get('low', '')} .. {quantity.get('high', '')}"
            print(f"DEBT a {who}, {trial['name']}, {quantity['name']}: {quantity['value']:.4g}, goal {goal}")
print(f"A {who} meets {met} of {met + missed} bars.")
if int(status) != (1 if missed else 0):
    sys.exit(f"FAILED: --check ended with {status}.")
if met < 100 or met < 4 * missed:
    sys.exit("FAILED: fewer than four bars in five are met.")
END
