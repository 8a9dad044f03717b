#!/bin/bash
# held.sh FLANEUR MAP: what a command must leave alone, and what it must not be kept from, whatever else is open, lies about
# or is called.
set -euo pipefail
flaneur=$1 map=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failed() { echo "FAILED: $*" && exit 1; }
said() { grep --quiet --extended-regexp "$1" said || failed "nothing like $1: $(cat said)"; }

# A closed standard file gives its number to no file of ours.
"$flaneur" gait --export whole.bvh > /dev/null
if "$flaneur" gait --export a.bvh >&- 2> said; then failed "nobody heard the table"; fi
said "Cannot write to standard output"
cmp a.bvh whole.bvh

# Devices and pipes are called as they like.
"$flaneur" gait --export /dev/stdout 2> /dev/null | cmp - whole.bvh
mkfifo pipe.glb
cat pipe.glb > piped &
"$flaneur" gait --export pipe.glb > /dev/null
wait $!
[[ $(head -c 4 piped) == glTF ]] || failed "a pipe called .glb takes something else"
if "$flaneur" gait --export a.txt 2> said; then failed "a .bvh called a.txt"; fi
said "which a.txt is not called"

# What another process of our number left behind is not in the way.
sh -c 'for i in 0 1 2; do echo old > ".flaneur-$$-$i.part"; done; exec "$0" gait --export c.bvh' "$flaneur" > /dev/null
cmp c.bvh whole.bvh
[[ $(cat .flaneur-*.part) == $'old\nold\nold' ]] || failed "a part of another's is gone"
rm .flaneur-*

# Nor are the files that a .gltf names written over.
"$flaneur" people --count 1 --out . > /dev/null
python3 - << 'END'
import json, struct
glb = open("person_01.glb", "rb").read()
length = struct.unpack("<I", glb[12:16])[0]
gltf = json.loads(glb[20:20 + length])
gltf["buffers"][0]["uri"] = "its%20own.bin"
gltf["images"] = [{"uri": "skin.png"}]
json.dump(gltf, open("man.gltf", "w"))
open("its own.bin", "wb").write(glb[28 + length:])
open("skin.png", "wb").write(b"picture")
json.dump({"people": [{"builtin": True}] * 3000}, open("many.json", "w"))
END
cp "its own.bin" before.bin
for out in "its own.bin" ./skin.png man.gltf; do
    if "$flaneur" inspect man.gltf --json "$out" 2> said > /dev/null; then failed "$out was written over"; fi
    said "this command reads it"
done
cmp "its own.bin" before.bin
"$flaneur" inspect man.gltf --json other.bin > /dev/null

# Who is named again is not loaded again.
(ulimit -t 60 && exec "$flaneur" sim --scene many.json --walkers 5 --seconds 0)

# A place whose numbers stand the other way round is known by the map.
sed 's|<osm [^>]*>|&<bounds minlat="52.47" minlon="13.42" maxlat="52.49" maxlon="13.44"/>|' "$map" > bounded.osm
if "$flaneur" inspect bounded.osm --center 13.431,52.4802 2> said; then failed "the places are the same"; fi
said "is not there, but 52.4802,13.4310 is: latitude comes first"
"$flaneur" inspect bounded.osm --center "52.4802, 13.431" --radius 100 > /dev/null

[[ $(XDG_CACHE_HOME=$folder/$'a\e[2J' "$flaneur" cache) == *'a\x1b[2J'* ]] || failed "a path steers the terminal"
