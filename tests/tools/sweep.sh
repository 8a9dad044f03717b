#!/bin/bash
# sweep.sh FLANEUR: every scene in every quality, nights, the views for work, and sizes from 1x1 to 4096x2160: the
# validation layer has nothing to say, and a second run, on another number of threads, writes the same bytes.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
draw() {
    "$flaneur" render --walkers 40 --frames 30 --size 480x270 "$@" 2> "$folder/said" || { cat "$folder/said" && exit 1; }
}
# twice NAME OPTIONS...
twice() {
    draw "${@:2}" --validate --threads 1 --out "$folder/a.png"
    draw "${@:2}" --threads 3 --out "$folder/b.png"
    cmp "$folder/a.png" "$folder/b.png" || { echo "FAILED: two runs of $1 differ." && exit 1; }
}
flaneur=$1
far=(--camera "22,13,34/1,0,0")
for quality in low medium high ultra; do
    for scene in corner square district; do twice "$scene, $quality" --scene $scene --quality $quality; done
    twice "asteroid, $quality" --scene asteroid --quality $quality "${far[@]}"
done
for quality in medium ultra; do
    twice "night, $quality" --scene corner --quality $quality --time 22:30
    twice "overview, $quality" --scene district --quality $quality --camera overview --view density,speed
    for view in wireframe,lods,gizmos normals,walkable overdraw skeletons,trails; do
        twice "$view, $quality" --scene corner --quality $quality --view $view
    done
done
twice "skeletons on the asteroid" --scene asteroid "${far[@]}" --view skeletons,trails,density,gizmos
for size in 1x1 1x720 1279x3 4096x2160; do
    for quality in medium ultra; do twice "$size, $quality" --scene corner --size $size --quality $quality --view skeletons; done
done
