#!/bin/bash
# shards.sh FLANEUR: parts of a film have the pictures that one process draws, whatever comes before them: of recordings and of what
# is simulated, of every tick and of some, with cameras that stay, choose, go along and move.
set -euo pipefail
flaneur=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failed() { echo "FAILED: $*" && cat said && exit 1; }
runs() { "$flaneur" "$@" > said 2>&1 || failed "$*"; }

cat > path.json << 'END'
{ "keys": [ { "time": 0, "eye": [60, 4, 37], "target": [49, 1, 41], "fov": 45 },
            { "time": 4, "eye": [0, 2, 40], "target": [-60, 1.5, 50], "fov": 45 } ] }
END
runs sim --scene life --walkers 100 --seconds 12 --record motion.flr
runs sim --scene life --walkers 100 --seconds 12 --record exact.flr --record-error 0
runs sim --scene life --walkers 100 --seconds 12 --record inputs.flr --record-as inputs
still=(--camera "61.06,4.12,37.25/48.76,0.82,41.45")

# same NAME WORDS...: parts 2, 3 and 4 of four have the pictures of all.
same() {
    local name=$1 part
    shift
    runs render --size 160x90 "$@" --out "$name/%04d.png"
    for part in 4 2 3; do
        runs render --size 160x90 "$@" --out "$name-parts/%04d.png" --shard $part/4
        grep -q "Wrote part $part of 4 of $name-parts/%04d.png, [0-9]* pictures" said || failed "$name does not say what it wrote"
    done
    local pictures=("$name-parts"/*) all=("$name"/*) file
    ((${#pictures[@]} == ${#all[@]} - ${#all[@]} / 4)) || failed "$name: ${#pictures[@]} pictures of ${#all[@]}"
    for file in "${pictures[@]}"; do cmp "$file" "$name/${file##*/}" || failed "$name: ${file##*/} is another"; done
    echo "$name: ${#pictures[@]} pictures are the same"
}
same motion --replay motion.flr --frames 100:699:1 "${still[@]}"
same motion_late --replay motion.flr --frames 560:639:1 "${still[@]}"
same motion_steps --replay motion.flr --frames 100:699:7 "${still[@]}"
same motion_street --replay motion.flr --frames 300:499:5 --camera street
same motion_follow --replay motion.flr --frames 300:499:5 --camera follow:7 --quality high
same motion_path --replay motion.flr --frames 300:540:3 --camera-path path.json
same motion_trails --replay motion.flr --frames 20:719:1 "${still[@]}" --view trails
same exact --replay exact.flr --frames 100:699:3 "${still[@]}"
same inputs --replay inputs.flr --frames 640:719:2 "${still[@]}"
same inputs_each --replay inputs.flr --frames 640:719:1 "${still[@]}"
same simulated --scene life --walkers 100 --frames 100:199:3 --camera overview
same simulated_lod --scene life --walkers 100 --frames 100:199:3 --camera-path path.json --lod 20

# More parts than pictures; a film of one picture; a part that is there.
film=(replay motion.flr --frames 60:62 --size 160x90 "${still[@]}" --out a.mp4)
for part in 1 2 3 4; do
    runs "${film[@]}" --shard $part/4
    (grep -q "of a.mp4 has no pictures" said && touch none) || grep -q "of 4 of a.mp4, 1 pictures" said || failed "part $part"
done
[[ -f none ]] || failed "each part of four has one of three pictures"
runs "${film[@]}" --shard 2/4
grep -q "part 2 of 4 of a.mp4, 1 pictures has them already" said || failed "it draws again"
runs join a.mp4
grep -q "Wrote a.mp4 of 3 pictures" said || failed "it does not say what it joined"
cp a.mp4 joined.mp4
runs "${film[@]}"
cmp a.mp4 joined.mp4 || failed "another film"
# Another recording of the same scene is another film.
runs sim --scene life --walkers 100 --seconds 2 --record other.flr
if "$flaneur" replay other.flr "${film[@]:2}" --shard 1/4 > said 2>&1; then failed "mixed two recordings"; fi
grep -q "begun with --replay motion.flr of .* not --replay other.flr" said || failed "it does not say which"
if "$flaneur" replay motion.flr --frames 60:63 "${film[@]:4}" --shard 1/4 > said 2>&1; then failed "mixed two lengths"; fi
grep -q "its film is of --frames 60:62:1, not 60:63:1" said || failed "it does not say how long"
echo nonsense > a.mp4.parts/plan
if "$flaneur" join a.mp4 > said 2>&1; then failed "joined by nonsense"; fi
grep -q "is no plan of a film" said || failed "it does not say what is wrong"
