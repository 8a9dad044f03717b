#!/bin/bash
# counters.sh FLANEUR: what a picture of the built-in city at street level takes stays within bounds that, unlike times,
# are the same on every machine: lavapipe draws, in medium quality.
set -euo pipefail
expect() {  # NAME MOST: of the last table
    local count
    count=$(sed -n "s/^$1 \+//p" "$table")
    if (( count < 1 || count > $2 )); then echo "FAILED: $1: $count, at most $2" && exit 1; fi
}
table=$(mktemp)
trap 'rm -f "$table"' EXIT
for load in "500 90000 37000" "2000 150000 66000"; do
    read -r walkers triangles vertices <<< "$load"
    "$1" bench frame --walkers "$walkers" --size 1280x720 --frames 1 --device llvmpipe --quality medium | tee "$table"
    expect "sub-draws" 300
    expect "direct draws" 20
    expect "triangles" "$triangles"
    expect "city vertices" "$vertices"
done
