#!/bin/bash
# hash_log.sh FLANEUR: --hash-log writes one line a tick, all different, the last with the hash that --hash prints. To
# standard output it goes alone, and only as long as somebody reads.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
hash=$("$1" sim --scene corner --seconds 2 --hash --hash-log "$folder/new/log.txt")
[[ $(wc -l < "$folder/new/log.txt") == 120 ]]
[[ $(cut -d' ' -f2 "$folder/new/log.txt" | sort -u | wc -l) == 120 ]]
[[ $(tail -1 "$folder/new/log.txt") == "120 $hash" ]]
[[ $(ls "$folder/new") == log.txt ]]

"$1" sim --scene corner --seconds 2 --hash --hash-log - > "$folder/dash" 2> "$folder/said"
cmp "$folder/dash" "$folder/new/log.txt"
grep --quiet --line-regexp "$hash" "$folder/said"
status=0
timeout 60 "$1" sim --scene corner --seconds 1000000 --hash-log - 2> "$folder/said" | head -1 > "$folder/first" || status=${PIPESTATUS[0]}
((status == 128 + $(kill -l PIPE)))
[[ $(cat "$folder/first") == "1 "* && $(cat "$folder/said") == "" ]]
if "$1" --help > /dev/full 2> "$folder/said"; then echo "FAILED: help that nobody got." && exit 1; fi
grep --quiet "Cannot write to standard output" "$folder/said"
