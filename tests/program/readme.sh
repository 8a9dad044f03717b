#!/bin/bash
# readme.sh FLANEUR README: every command of flaneur that README shows, on lines of its own or in the text, runs as it is
# written and writes what it says; a few streets, people and ways of our own stand in for map.osm, me.glb, robot.glb and
# bottleneck.txt. What is viewed is viewed for five frames, on a display of its own.
set -euo pipefail
readme=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin" "$folder/here"
ln -s "$1" "$folder/bin/flaneur"
export PATH=$folder/bin:$PATH
cd "$folder/here"
python3 - > map.osm << 'END'
print('<osm version="0.6">')
for x in range(3):
    for y in range(3):
        print(f'<node id="{1 + 3 * x + y}" version="1" lat="{52.48 + 0.001 * y}" lon="{13.43 + 0.002 * x}"/>')
for i, nodes in enumerate([(1, 2, 3), (4, 5, 6), (7, 8, 9), (1, 4, 7), (2, 5, 8), (3, 6, 9)]):
    print(f'<way id="{i + 1}" version="1">', *(f'<nd ref="{n}"/>' for n in nodes))
    print('<tag k="highway" v="residential"/><tag k="sidewalk" v="both"/></way>')
print("</osm>")
END
flaneur people --count 2 --out . > /dev/null
mv person_01.glb me.glb
mv person_02.glb robot.glb
awk 'BEGIN { for (f = 0; f < 26; ++f) for (i = 1; i <= 3; ++i) printf "%d %d %.3f %.3f\n", i, f, 0.05 * f, i }' > bottleneck.txt

commands=0
while read -r line; do
    echo "$line"
    read -ra words <<< "$line"
    if [[ ${words[1]} == view ]]; then
        xvfb-run -a -s "-screen 0 1400x900x24" "${words[@]}" --frames 5
    else
        "${words[@]}" > said
        [[ -s said || " $line " == *" --out "* || " $line " == *" --record "* || ${words[1]} == export ]]
    fi
    for ((i = 2; i < ${#words[@]} - 1; ++i)); do
        if [[ ${words[i]} =~ ^--(out|record|json|sheet|csv|svg|strip)$ && ! -s ${words[i + 1]} ]]; then
            echo "FAILED: it has not written ${words[i + 1]}." && exit 1
        fi
    done
    commands=$((commands + 1))
done < <(sed -n 's/^    \(flaneur .*\)/\1/p' "$readme" | sed 's/ *#.*//'; grep -o '`flaneur [^`]*`' "$readme" | tr -d '`')
((commands >= 10))

# Scenes, too.
scenes=0
while read -r scene; do
    echo "$scene" > "scene.json"
    flaneur sim --scene scene.json --seconds 1
    scenes=$((scenes + 1))
done < <(sed -n 's/^    \({ .*}\)$/\1/p' "$readme")
((scenes >= 1))
