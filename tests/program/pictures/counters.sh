#!/bin/bash
# counters.sh FLANEUR: what a picture of the built-in city at street level takes stays within bounds that, unlike times,
# are the same on every machine: lavapipe draws, in medium quality. From one place, wherever people are.
set -euo pipefail
expect() {  # NAME MOST: of the last table
    local count
    count=$(sed -n "s/^$1 \+//p" "$table")
    if (( count < 1 || count > $2 )); then echo "FAILED: $1: $count, at most $2" && exit 1; fi
}
table=$(mktemp)
trap 'rm -f "$table"' EXIT
for load in "500 90000 62000" "2000 150000 66000"; do
    read -r walkers triangles vertices <<< "$load"
    "$1" bench frame --walkers "$walkers" --size 1280x720 --camera 34.2,1.72,48.3/41.3,1.37,41.2 \
        --frames 1 --device llvmpipe --quality medium | tee "$table"
    expect "sub-draws" 300
    expect "direct draws" 20
    expect "triangles" "$triangles"
    expect "city vertices" "$vertices"
done
