#!/bin/bash
# isa.sh FLANEUR NAME: golden.sh's NAME has its hash on each instruction set that this CPU has.
set -euo pipefail
sentence=$("$1" sim --isa none 2>&1) || true
here=$(sed -E 's/.* it has ([a-z0-9, ]+) and best.*/\1/; s/,//g' <<< "$sentence")
echo "This CPU has $here."
[[ -n $here ]]
for isa in $here best; do "$(dirname "$0")/golden.sh" "$1" "$2" --isa "$isa"; done
