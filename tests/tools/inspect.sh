#!/bin/bash
# inspect.sh FLANEUR MAP: what inspect says of one of our own people and of a small map, as text and as JSON.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
map=$2
cd "$folder"
# said FILE PATTERN: FILE has a line that matches.
said() { if ! grep --quiet --extended-regexp "$2" "$1"; then echo "FAILED: nothing like $2 in:" && cat "$1" && exit 1; fi; }

"$1" people --count 1 --seed 3 --out . > /dev/null
"$1" inspect person_01.glb --json person.json > person.txt
said person.txt '^height, m +[12]\.[0-9]'
said person.txt '^ahead +\+z$'
said person.txt '^skins +1$'
said person.txt '^  left upper arm +leftUpperArm$'
said person.json '"left_upper_arm": "leftUpperArm"'
said person.json '"notes": \[\]'

"$1" inspect "$map" --json map.json > map.txt
said map.txt '^buildings +1$'
said map.txt '^  trees +1$'
said map.txt '^  sidewalk +[1-9]'
said map.json '"kind": "map"'
