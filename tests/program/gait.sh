#!/bin/bash
# gait.sh FLANEUR [SANITIZERS]: `flaneur gait` writes a table, a CSV, JSON and an SVG that hold together.
set -euo pipefail
flaneur=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$flaneur" gait --speed 1.3 --csv a.csv --json a.json --svg a.svg > table.txt
grep --quiet 'thigh.rmse .*<= 4 ' table.txt
grep --quiet 'bars met' table.txt
head -1 a.csv | grep --quiet '^person,trial,quantity,percent,value,norm,low,high,pass$'
if awk -F, 'NF != 9' a.csv | grep .; then echo "FAILED: rows of another length" && exit 1; fi
(($(grep --count '^man_30,level_1.30,knee,' a.csv) == 101))
python3 - << 'END'
import json, xml.dom.minidom
report = json.load(open("a.json"))
trial = report["trials"][0]
assert len(trial["curves"]["knee"]) == 101 and len(report["norm"]["knee"]) == 101
assert any(q["name"] == "knee.rmse" and q["high"] == 5 and "pass" in q for q in trial["quantities"])
assert xml.dom.minidom.parse("a.svg").documentElement.tagName == "svg"
END
# Every walk ends, in little memory, of which a sanitizer sets aside more than there is.
if [[ -z ${2-} ]]; then ulimit -v 4000000; fi
for walk in "--turn 180" "--turn -45" "--kerb 0.15" "--stairs down" "--slope 20"; do
    read -ra words <<< "$walk"
    timeout 60 "$flaneur" gait "${words[@]}" --style 3 > walk.txt
    grep --quiet 'bars met' walk.txt
done
"$flaneur" gait --age 30.5 --slope 5 > walk.txt
grep --quiet '^A man of 30.5 years' walk.txt
# An exported motion is as long as was asked for.
"$flaneur" gait --seconds 12 --export level.bvh > walk.txt
grep --quiet '^Frames: 720$' level.bvh
"$flaneur" gait --turn 90 --seconds 15 --export turn.bvh > walk.txt
grep --quiet '^Frames: 900$' turn.bvh
# One word for every walk: another one for another walk.
poses() { "$flaneur" gait "$@" | grep '^Poses '; }
if [[ $(poses --kerb 0.12) == "$(poses --kerb 0.1)" ]]; then echo "FAILED: two kerbs, one word" && exit 1; fi
"$flaneur" gait --help > help.txt
grep --quiet -- '--seconds .*(12 to 600)$' help.txt
# What is exported of a crowd is a character.
"$flaneur" gait --crowd 20 --seconds 12 --walker 3 --export one.glb > crowd.txt
grep --quiet 'joint_speed' crowd.txt
"$flaneur" inspect one.glb --json one.json > inspected.txt
python3 - << 'END'
import json
one = json.load(open("one.json"))
assert one["kind"] == "character" and one["animations"] == ["motion"] and not one["notes"], one
assert len(one["joints"]) == 22 and all(one["joints"].values()), one["joints"]
END
