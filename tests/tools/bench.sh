#!/bin/bash
# bench.sh FLANEUR "STAGE..." WORDS...: `FLANEUR bench WORDS` prints each stage and writes it as JSON.
set -euo pipefail
flaneur=$1 stages=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$flaneur" bench "$@" --json "$folder/figures.json" | tee "$folder/table"
for stage in $stages; do
    grep --quiet -E "^$stage +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+$" "$folder/table"
    grep --quiet "\"name\": \"$stage\"" "$folder/figures.json"
done
