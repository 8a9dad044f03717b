#!/bin/bash
# gpu.sh FLANEUR [DEVICE]: on whatever GPU is there, or a named device: each scene by day and by night looks as Mesa's
# CPU driver draws it, the validation layer has nothing to say, a second run on another number of threads writes the
# same bytes, and light by the host is the same within 1 of 255, but for few edges that
# other roundings let be smoothed otherwise. Then it says how long frames take.
set -euo pipefail
flaneur=$1
device=${2-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
here=$(dirname "$0")
draw() {
    "$flaneur" render --walkers 200 --frames 60 --quality medium "$@" 2> "$folder/said" || { cat "$folder/said" && exit 1; }
}
draw ${device:+--device "$device"} --scene corner --size 64x64 --out "$folder/a.png"
name=$(sed -n 's/^Drawing on \(.*\), Vulkan .*/\1/p' "$folder/said")
[[ -n $name ]] || { cat "$folder/said" && exit 1; }
if [[ -z $device && $name == llvmpipe* ]]; then
    echo "SKIPPED: there is no GPU here, but only $name"
    exit 77
fi
echo "On $name:"
on_gpu=(--device "${device:-${name%% (*}}")
for scene in corner square district asteroid; do
    for time in 17:30 22:30; do
        words=(--scene "$scene" --time "$time")
        if [[ $scene == asteroid ]]; then words+=(--camera 22,13,34/1,0,0); fi
        echo "${words[*]}"
        draw "${words[@]}" "${on_gpu[@]}" --validate --threads 1 --out "$folder/a.png"
        draw "${words[@]}" "${on_gpu[@]}" --threads 3 --out "$folder/b.png"
        cmp "$folder/a.png" "$folder/b.png" || { echo "FAILED: two runs differ." && exit 1; }
        draw "${words[@]}" "${on_gpu[@]}" --light host --out "$folder/b.png"
        "$here/differ.py" "$folder/a.png" "$folder/b.png" 1 0.0005
        # Edges and last bits may fall otherwise, but nothing may be missing.
        draw "${words[@]}" --device llvmpipe --out "$folder/b.png"
        "$here/differ.py" "$folder/a.png" "$folder/b.png" 16 0.01
    done
done
for walkers in 500 10000 100000; do
    "$flaneur" bench frame "${on_gpu[@]}" --walkers $walkers --camera crowd --frames 30 2> "$folder/said" |
        grep -E '^ *(walkers|quality|size|step|record|gpu|frame|all threads)'
done
