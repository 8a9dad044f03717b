#!/bin/bash
# isa.sh FLANEUR WORDS...: `FLANEUR sim WORDS --hash` prints the same hash on each instruction set that this CPU has.
set -euo pipefail
flaneur=$1
shift
sentence=$("$flaneur" sim --isa none 2>&1) || true
here=$(sed -E 's/.* it has ([a-z0-9, ]+) and best.*/\1/; s/,//g' <<< "$sentence")
best=$("$flaneur" sim "$@" --hash)
[[ $best =~ ^[0-9a-f]{16}$ ]]
echo "best $best"
for isa in $here; do
    hash=$("$flaneur" sim "$@" --hash --isa "$isa")
    echo "$isa $hash"
    if [[ $hash != "$best" ]]; then echo "FAILED: $isa gives another hash." && exit 1; fi
done
[[ -n $here ]]
