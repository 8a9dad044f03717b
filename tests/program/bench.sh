#!/bin/bash
# bench.sh FLANEUR "NAME..." WORDS...: `FLANEUR bench WORDS` prints a row of figures for each stage or kernel and writes
# it as JSON.
set -euo pipefail
flaneur=$1 names=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$flaneur" bench "$@" --json "$folder/figures.json" | tee "$folder/table"
for name in $names; do
    grep --quiet -E "^ *$name +[0-9]+[.][0-9]" "$folder/table"
    # "with LOD/frame", "core/avx2"
    grep --quiet -E "\"name\": \"([^\"]*/)?$name[\"/]" "$folder/figures.json"
done
