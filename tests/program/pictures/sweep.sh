#!/bin/bash
# sweep.sh FLANEUR: every two of the scenes, qualities, hours, weathers, cameras, sizes and views for work together, and
# pictures of one pixel and of nine million: the validation layer has nothing to say. Of every two, one is drawn again on
# another number of threads, which writes the same bytes, and one lit by the device rather than by the host, which is the
# same within 1 of 255.
set -euo pipefail
flaneur=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
draw() {
    "$flaneur" render --walkers 40 --frames 30 "$@" 2> "$folder/said" || { cat "$folder/said" && exit 1; }
}
drawn=0
twice() {
    echo "$*"
    draw "$@" --validate --threads 1 --out "$folder/a.png"
    if ((drawn++ % 2)); then
        draw "$@" --light device --out "$folder/b.png"
        "$(dirname "$0")/differ.py" "$folder/a.png" "$folder/b.png" 1
    else
        draw "$@" --threads 3 --out "$folder/b.png"
        cmp "$folder/a.png" "$folder/b.png" || { echo "FAILED: two runs differ." && exit 1; }
    fi
}
rows=0
while read -r scene quality time weather camera size view; do
    words=(--scene "$scene" --quality "$quality" --time "$time" --weather "$weather" --size "$size")
    if [[ $scene == asteroid ]]; then  # which has no streets, nor a plane of ground
        camera=22,13,34/1,0,0 view=${view/+walkable/} view=${view/density+/}
    fi
    if [[ $view != none ]]; then words+=(--view "${view//+/,}"); fi
    twice "${words[@]}" --camera "$camera"
    rows=$((rows + 1))
done < <("$(dirname "$0")/pairs.py" scene=corner,square,district,asteroid quality=low,medium,high,ultra time=17:30,22:30 \
    weather=clear,overcast camera=street,overview,follow:3 size=480x270,1x720,1279x3 \
    view=none,wireframe+lods+gizmos+walkable,normals+skeletons+trails,overdraw+density+speed)
((rows >= 16))
for size in 1x1 1x1 4096x2160; do twice --scene corner --size $size --quality ultra --view skeletons; done
