#!/bin/bash
# golden.sh FLANEUR NAME [WORDS...]: the state that `FLANEUR sim` computes has the hash that hashes.txt says for
# NAME, whatever the WORDS (--threads 3) and the build. Skips, with 77, where the city's file is not there.
# golden.sh FLANEUR --write: makes hashes.txt say what FLANEUR computes. Only for a change that is meant.
set -euo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
table=$folder/hashes.txt
flaneur=$1 wanted=$2
shift 2

if [[ $wanted == --write ]]; then grep '^#' "$table" > "$table.part"; fi
checked=0
while read -r name kind city walkers seconds hash; do
    if [[ $wanted != --write && $wanted != "$name" ]]; then continue; fi
    if [[ $kind == --city ]]; then city=$folder/$city; fi
    if [[ $kind == --city && ! -e $city ]]; then
        echo "SKIPPED: $city is not here, so nothing is said about $name."
        if [[ $wanted == --write ]]; then rm "$table.part" && exit 1; fi
        exit 77
    fi
    now=$("$flaneur" sim "$kind" "$city" --walkers "$walkers" --seconds "$seconds" --hash "$@")
    if [[ $wanted == --write ]]; then
        echo "$name $kind ${city#"$folder/"} $walkers $seconds $now" >> "$table.part"
    elif [[ $now != "$hash" ]]; then
        echo "FAILED: $name has the hash $now, not $hash. If behaviour was meant to change: tests/program/golden/golden.sh FLANEUR --write"
        exit 1
    fi
    checked=$((checked + 1))
done < <(grep -v '^#' "$table")
if [[ $wanted == --write ]]; then mv "$table.part" "$table"; fi
if ((checked == 0)); then echo "FAILED: hashes.txt does not know $wanted." && exit 1; fi
