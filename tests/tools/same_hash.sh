#!/bin/bash
# same_hash.sh FLANEUR FLANEUR2 WORDS... -- WORDS2...: `FLANEUR sim WORDS --hash` and `FLANEUR2 sim WORDS2 --hash`
# must print the same hash.
set -euo pipefail
first=("$1" sim) second=("$2" sim)
shift 2
while [[ $1 != -- ]]; do first+=("$1") && shift; done
shift
second+=("$@")
# Two programs make their people each for itself: nothing that one keeps on disk may stand in for the other's.
if [[ ${first[0]} != "${second[0]}" ]]; then
    kept=$(mktemp -d)
    trap 'rm -rf "$kept"' EXIT
    first=(env XDG_CACHE_HOME="$kept/1" "${first[@]}") second=(env XDG_CACHE_HOME="$kept/2" "${second[@]}")
fi
hash=$("${first[@]}" --hash)
hash2=$("${second[@]}" --hash)
echo "$hash from ${first[*]}"
echo "$hash2 from ${second[*]}"
[[ $hash =~ ^[0-9a-f]{16}$ && $hash == "$hash2" ]]
