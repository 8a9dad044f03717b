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
said person.txt '^below +677 pixels +[0-9]+ triangles, silhouette [0-9.]+ %, colour [0-9.]+ % off$'
said person.json '"left_upper_arm": "leftUpperArm"'
said person.json '"silhouette": 0\.[0-9]'
said person.json '"notes": \[\]'

"$1" inspect "$map" --json map.json > map.txt
"$1" inspect "$map" --json - 2> dash.txt | cmp - map.json
cmp dash.txt map.txt
"$1" inspect "$map" --json /dev/stdout 2> /dev/null | cmp - map.json
said map.txt '^buildings +1$'
said map.txt '^  trees +1$'
said map.txt '^  latitude +52[.]480'
said map.txt '^drawn +the whole map$'
said map.json '"radius_m": null'
"$1" inspect "$map" --center 52.4802,13.431 --radius 100 > part.txt
said part.txt '^radius, m +100$'
said part.txt '^drawn +a square about the center$'
said map.txt '^  sidewalk +[1-9]'
said map.json '"kind": "map"'

# Rails are no house.
sed 's|</osm>|<way id="90" version="1"><nd ref="2"/><nd ref="7"/><tag k="railway" v="rail"/></way></osm>|' "$map" > rails.osm
"$1" inspect rails.osm > rails.txt
said rails.txt '^buildings +1$'
said rails.txt '^  railway tracks +1'

# The kind of a file is told by how its name ends, whatever its folder is called.
mkdir my.osm.people
cp person_01.glb my.osm.people/
"$1" inspect my.osm.people/person_01.glb > person.txt
said person.txt '^skins +1$'

# A character that is refused is not taken for a city, whose ground this one would have six hundred times.
python3 - << 'END'
import base64, json, struct
layers, cells = 600, 20
side = cells + 1
points = b"".join(struct.pack("<3f", x, 0, z) for z in range(side) for x in range(side))
joints = struct.pack("<4B", 0, 0, 0, 0) * side * side
weights = struct.pack("<4f", 1, 0, 0, 0) * side * side
at = lambda x, z: z * side + x
faces = b"".join(struct.pack("<6H", at(x, z), at(x, z + 1), at(x + 1, z), at(x + 1, z), at(x, z + 1), at(x + 1, z + 1))
                 for z in range(cells) for x in range(cells))
views, begin = [], 0
for part in (points, joints, weights, faces):
    views.append({"buffer": 0, "byteOffset": begin, "byteLength": len(part)})
    begin += len(part)
uri = "data:application/octet-stream;base64," + base64.b64encode(points + joints + weights + faces).decode()
accessor = lambda view, of, count, kind: {"bufferView": view, "componentType": of, "count": count, "type": kind}
surface = {"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3}
json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
           "nodes": [{"mesh": 0, "skin": 0}, {"name": "bone"}], "skins": [{"joints": [1]}],
           "buffers": [{"byteLength": begin, "uri": uri}], "bufferViews": views,
           "accessors": [accessor(0, 5126, side * side, "VEC3") | {"min": [0, 0, 0], "max": [cells, 0, cells]},
                         accessor(1, 5121, side * side, "VEC4"), accessor(2, 5126, side * side, "VEC4"),
                         accessor(3, 5123, cells * cells * 6, "SCALAR")],
           "meshes": [{"primitives": [surface] * layers}]}, open("layers.gltf", "w"))
END
if (ulimit -t 20 && exec "$1" inspect layers.gltf > layers.txt 2>&1); then echo "FAILED: one joint is a person." && exit 1; fi
said layers.txt '^flaneur: layers.gltf: '

# What has no skeleton is nobody, and no map either.
"$1" city --scene corner --out town.glb > /dev/null
"$1" inspect town.glb > town.txt
said town.txt '^kind +thing without a skeleton$'
said town.txt '^buildings +0$'

# Two legs and a trunk: refused by the limbs that are missing, unless it is forced to walk.
python3 - << 'END'
import base64, json, struct
bones = [("pelvis", None, (0, 0.9, 0), (0, 1.5, 0))]
for name, x in (("left", 0.12), ("right", -0.12)):
    hip = len(bones)
    bones += [(name + " thigh", 0, (x, 0.88, 0), (x, 0.46, 0)), (name + " shin", hip, (x, 0.46, 0), (x, 0.08, 0)),
              (name + " foot", hip + 1, (x, 0.08, 0), (x, 0, 0.16))]
points, faces, joints, binds, nodes = [], [], [], [], []
for j, (name, parent, (x, y, z), to) in enumerate(bones):
    first = len(points)
    points += [(x - 0.03, y, z), (x + 0.03, y, z), (x, y, z + 0.03), to]
    faces += [first + i for i in (0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0)]
    joints += [(j, 0, 0, 0)] * 4
    binds += [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1]
    above = bones[parent][2] if parent is not None else (0, 0, 0)
    nodes.append({"name": name, "translation": [a - b for a, b in zip((x, y, z), above)],
                  **({"children": c} if (c := [k for k, b in enumerate(bones) if b[1] == j]) else {})})
parts = [b"".join(struct.pack("<3f", *p) for p in points), b"".join(struct.pack("<4B", *j) for j in joints),
         struct.pack("<4f", 1, 0, 0, 0) * len(points), struct.pack("<%dH" % len(faces), *faces),
         struct.pack("<%df" % len(binds), *binds)]
kinds = [(5126, len(points), "VEC3"), (5121, len(points), "VEC4"), (5126, len(points), "VEC4"), (5123, len(faces), "SCALAR"),
         (5126, len(bones), "MAT4")]
whole = b"".join(parts)
json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, len(nodes)]}],
           "nodes": nodes + [{"mesh": 0, "skin": 0}],
           "skins": [{"joints": list(range(len(bones))), "inverseBindMatrices": 4}],
           "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3}]}],
           "buffers": [{"byteLength": len(whole),
                        "uri": "data:application/octet-stream;base64," + base64.b64encode(whole).decode()}],
           "bufferViews": [{"buffer": 0, "byteOffset": sum(map(len, parts[:i])), "byteLength": len(part)}
                           for i, part in enumerate(parts)],
           "accessors": [{"bufferView": i, "componentType": of, "count": n, "type": t}
                         for i, (of, n, t) in enumerate(kinds)]}, open("legs.gltf", "w"))
END
if "$1" inspect legs.gltf > legs.txt 2>&1; then echo "FAILED: legs are a person." && exit 1; fi
said legs.txt 'neither its left nor its right arm was found'
"$1" inspect legs.gltf --force > legs.txt
said legs.txt '^  left foot +left foot$'
said legs.txt '^  head +-, made up'
"$1" sim --scene corner --walkers 20 --seconds 1 --character legs.gltf --force --hash > legs.txt 2> said.txt
said said.txt 'legs.gltf: .*forced'
