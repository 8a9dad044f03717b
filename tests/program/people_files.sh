#!/bin/bash
# people_files.sh FLANEUR: people writes as many files as it is asked for, the same ones for the same seed on any
# number of threads, made anew, and they walk, among others too.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
expect() { if [[ $1 != "$2" ]]; then echo "FAILED: '$1' instead of '$2'" && exit 1; fi; }

"$1" people --count 2 --seed 5 --out a > table
expect "$(wc -l < table)" 2
expect "$(cd a && echo *)" "person_01.glb person_02.glb"
XDG_CACHE_HOME=$folder/cold "$1" people --count 2 --seed 5 --threads 1 --out b > /dev/null
"$1" people --count 2 --seed 6 --out c > /dev/null
diff -r a b
if cmp -s a/person_01.glb c/person_01.glb; then echo "FAILED: another seed gives the same person." && exit 1; fi
"$1" sim --scene corner --seconds 1 --character a/person_01.glb --character a/person_02.glb --hash > hash
[[ -s hash ]]
cat > mixed.json << END
{ "walkers": 60, "blocks": 1, "people": [{ "character": "a/person_01.glb", "share": 1 }, { "builtin": true, "share": 9 }] }
END
"$1" sim --seconds 1 --scene mixed.json --hash > mixed
"$1" sim --seconds 1 --scene corner --walkers 60 --character a/person_01.glb --character builtin:9 --hash > same
cmp mixed same
for shares in 1:9 9:1; do
    "$1" sim --seconds 1 --scene corner --character "a/person_01.glb:${shares%:*}" \
        --character "a/person_02.glb:${shares#*:}" --hash > "$shares"
done
if cmp -s 1:9 9:1; then echo "FAILED: shares change nothing." && exit 1; fi
