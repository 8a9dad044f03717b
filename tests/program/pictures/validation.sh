#!/bin/bash
# validation.sh FLANEUR: the validation layer has nothing to say about drawing off-screen, each camera, --device,
# the views for work, scenery and the asteroid.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for camera in street overview follow:0 eyes:1 map map:3,-4,60,30; do
    "$1" render --validate --scene corner --frames 20:30:5 --size 320x180 --camera $camera --out "$folder/%03d.png"
done
"$1" render --validate --scene corner --walkers 0 --frames 0 --size 33x17 --device 0 --out "$folder/empty.png"
for view in wireframe,lods normals,skeletons,gizmos overdraw speed,density,trails walkable,skeletons; do
    "$1" render --validate --scene corner --frames 60 --size 320x180 --view $view --out "$folder/view.png"
done
"$1" city --scene corner --out "$folder/city.glb"
"$1" render --validate --city "$folder/city.glb" --walkers 5 --frames 5 --size 320x180 --out "$folder/scenery.png"
"$1" render --validate --scene asteroid --walkers 9 --frames 5 --size 320x180 --out "$folder/asteroid.png"

# It would be heard: with advice switched on, which the renderer does not follow to the letter, the program fails.
export VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT
if "$1" render --validate --scene corner --walkers 3 --frames 0 --size 64x64 --out "$folder/x.png" 2> "$folder/said"; then
    echo "FAILED: validation messages do not count." && exit 1
fi
grep '^flaneur: The validation layer had something to say' "$folder/said"
