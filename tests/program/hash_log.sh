#!/bin/bash
# hash_log.sh FLANEUR: --hash-log writes one line a tick, all different, the last with the hash that --hash prints.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
hash=$("$1" sim --scene corner --seconds 2 --hash --hash-log "$folder/new/log.txt")
[[ $(wc -l < "$folder/new/log.txt") == 120 ]]
[[ $(cut -d' ' -f2 "$folder/new/log.txt" | sort -u | wc -l) == 120 ]]
[[ $(tail -1 "$folder/new/log.txt") == "120 $hash" ]]
[[ $(ls "$folder/new") == log.txt ]]
