#!/bin/bash
# scenes.sh FLANEUR SCENES: the built-in scenes are listed with a line on each; --schema is the file that stands beside them;
# --check finds every fault of every file, with its place.
set -euo pipefail
flaneur=$1 scenes=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
expect() { if [[ $1 != "$2" ]]; then echo "FAILED: '$1' instead of '$2'" && exit 1; fi; }
said() { if ! grep --quiet --line-regexp --extended-regexp "$1" check.txt; then echo "FAILED: nothing like $1 in:" && cat check.txt && exit 1; fi; }

"$flaneur" scenes > list.txt
expect "$(grep --count -E '^[a-z-]+ +[A-Z].{10,}$' list.txt)" "$(find "$scenes" -name '*.json' -not -name '*.schema.json' | wc -l)"
"$flaneur" scenes --schema | cmp - "$scenes/scene.schema.json"
find "$scenes" -name "*.json" -not -name "*.schema.json" -exec "$flaneur" scenes --check district {} + > good.txt
expect "$(grep --count ': good$' good.txt)" "$(($(find "$scenes" -name '*.json' -not -name '*.schema.json' | wc -l) + 1))"

echo '{ "walkers": 3 }' > good.json
cat > bad.json << 'END'
{
    "about": "Zürich", "walkers": -1,
    "people": [{ "builtin": true }, { "builtin": true, "share": 0 }],
    "wlakers": [1, "}", 3],
    "camera": "sideways"
}
END
printf '{\n  "walkers": 3,\n}\n' > broken.json
printf '{ "walkers": 1e999 }\n' > large.json
printf '{ "built": "asteroid",\n  "city": "a.osm" }\n' > both.json
echo '{ "walkers": 5, "camera": "follow:5" }' > nobody.json
echo '{ "seed": 18446744073709551616, "city": "" }' > beyond.json
mkfifo pipe.json
echo '{ "city": "gone.osm" }' > gone.json
# What can be known without simulating, in the sentence of every other command.
field='"built": "platform", "platform"'
echo "{ $field: \"0,0 40,0 40,1 0,1\", \"walkers\": 3 }" > narrow.json
echo "{ $field: \"0,0 40,0 40,1 0,1\", \"walkers\": 3, \"habit\": \"stagger\" }" > narrow2.json
echo "{ $field: \"0,0 6,0 6,6 0,6\", \"walkers\": 5000 }" > full.json
echo '{ "built": "field", "walkers": 50000 }' > full2.json
echo '{ "built": "platform", "walkers": 3, "added": [{ "what": "wall", "at": "0,0,0", "to": "30,0,0" }] }' > wet.json
for name in narrow narrow2 full full2 wet; do
    if "$flaneur" scenes --check $name.json > check.txt 2> /dev/null; then echo "FAILED: $name is good." && exit 1; fi
    if "$flaneur" sim --scene $name.json --seconds 0 2> sentence.txt; then echo "FAILED: $name is simulated." && exit 1; fi
    cat check.txt
    expect "$(sed "s/^$name\.json: /flaneur: /" check.txt)" "$(cat sentence.txt)"
    expect "$(wc -l < check.txt)" 1
done
echo "{ $field: \"0,0 3,0 6,0 6,6 0,6\", \"walkers\": 3 }" > midway.json
echo "{ $field: \"0,0 20,0 10,30\", \"walkers\": 3, \"prams\": 0, \"habit\": \"stagger\" }" > sharp.json
echo "{ $field: \"0,0 6,0 6,0 6,6 0,6\" }" > twice.json
if "$flaneur" scenes --check midway.json sharp.json twice.json > check.txt 2> /dev/null; then echo "FAILED: a corner is there twice." && exit 1; fi
said 'midway\.json: good'
said 'sharp\.json: good'
said 'twice\.json:1:36: "platform": 0,0 6,0 6,0 6,6 0,6: The platform has the corner 6,0 twice: leave one out\.'

if timeout 20 "$flaneur" scenes --check gone.json pipe.json good.json bad.json broken.json large.json both.json nobody.json beyond.json nowhere.json > check.txt 2> sentence.txt; then
    echo "FAILED: faults do not count." && exit 1
fi
cat check.txt sentence.txt
said 'good\.json: good'
said 'gone\.json: There is no file gone\.osm; check the path\.'
said 'Cannot read the scene pipe\.json: it is a pipe or a device, .*'
said 'bad\.json:2:35: "walkers" must be a whole number from 0 to 1000000, not -1\.'
said 'bad\.json:3:65: in "people", number 2: "share" must be a number from 0.001 to 1000, not 0\.'
said 'bad\.json:4:5: "wlakers" is not known; a scene may have .*'
said 'bad\.json:5:15: "camera": sideways is none of .*'
said 'broken\.json:3:1: this is not JSON\.'
said 'large\.json:1:14: this number is too large\.'
said 'both\.json:1:3: "built" is a place of its own, and "city" another; .*'
said 'nobody\.json:1:27: "camera" follows nobody: walkers are numbered from 0, and there are 5\.'
said 'beyond\.json:1:11: "seed" must be a whole number from 0 to 18446744073709551615, not 18446744073709551616\.'
said 'beyond\.json:1:41: "city" must be a text of some letters, not ""\.'
said 'Cannot read the scene nowhere\.json.*'
expect "$(wc -l < check.txt)" 14
expect "$(cat sentence.txt)" "flaneur: 9 of 10 scenes cannot be used; the lines above say why."

# An unreadable scene and a sound one make no good check.
if "$flaneur" scenes --check good.json nowhere.json > /dev/null 2>&1; then echo "FAILED: a missing file is good." && exit 1; fi
