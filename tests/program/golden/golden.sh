#!/bin/bash
# golden.sh FLANEUR NAME [WORDS...]: what `FLANEUR sim` computes of the world that worlds.txt calls NAME has, after each
# second, the hash that NAME.txt says, whatever the WORDS (--threads 3) and the build. Skips, with 77, where the city's
# file is not there.
# golden.sh FLANEUR --write: makes NAME.txt of all worlds say what FLANEUR computes. Only for a change that is meant.
set -euo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
flaneur=$1 wanted=$2
shift 2

# hashes WORDS...: a line for each second.
hashes() {
    "$flaneur" sim "$@" --hash-log - | awk '$1 % 60 == 0 { print $1 / 60, $2 }'
}

checked=0
while read -r name kind city walkers seconds; do
    if [[ $wanted != --write && $wanted != "$name" ]]; then continue; fi
    if [[ $kind == --city ]]; then city=$folder/$city; fi
    if [[ $kind == --city && ! -e $city ]]; then
        echo "SKIPPED: $city is not here, so nothing is said about $name."
        if [[ $wanted == --write ]]; then exit 1; fi
        exit 77
    fi
    world=("$kind" "$city" --walkers "$walkers")
    now=$(hashes "${world[@]}" --seconds "$seconds" "$@")
    if [[ $wanted == --write ]]; then
        echo "$now" > "$folder/$name.txt"
    elif ! differing=$(diff <(echo "$now") "$folder/$name.txt"); then
        second=$(sed -nE 's/^[<>] ([0-9]+) .*/\1/p' <<< "$differing" | sort -n | head -1)
        echo "FAILED: $name is another from second $second of $seconds on: its hash is \"$(grep "^$second " <<< "$now" | cut -d' ' -f2)\", not \"$(grep "^$second " "$folder/$name.txt" | cut -d' ' -f2)\"."
        echo "The first tick, walker and field that differ, by a flaneur that still has the hashes (or two logs of machines: flaneur sim --help):"
        echo "  $flaneur check --sim --with FLANEUR_BEFORE ${world[*]} --seconds $second${*:+ $*}"
        echo "If behaviour was meant to change: tests/program/golden/golden.sh FLANEUR --write"
        exit 1
    fi
    checked=$((checked + 1))
done < <(grep -v '^#' "$folder/worlds.txt")
if ((checked == 0)); then echo "FAILED: worlds.txt does not know $wanted." && exit 1; fi
