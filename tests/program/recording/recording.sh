#!/bin/bash
# recording.sh FLANEUR [VULKAN]: recordings are made, read, compared and shown by the commands; what is damaged, cut or no
# recording is refused or read as far as it goes, in a sentence.
set -euo pipefail
flaneur=$1 vulkan=${2-}
here=$(realpath "$(dirname "$0")")
# shellcheck source-path=SCRIPTDIR source=says.sh
. "$here/says.sh"

corner=(sim --scene corner --walkers 30 --seconds 3)
runs "Recorded a.flr" "${corner[@]}" --record a.flr
runs "Recorded b.flr" "${corner[@]}" --record b.flr --threads 1
runs "Recorded exact.flr" "${corner[@]}" --record exact.flr --record-error 0
runs "Recorded other.flr" "${corner[@]}" --seed 2 --record other.flr
runs "Recorded in.flr" "${corner[@]}" --record in.flr --record-as inputs
cmp a.flr b.flr || failed "the same run, other bytes"
runs "motion of corner, .*ticks 0 to 180" replay a.flr --check
runs "motion of corner, .*ticks 0 to 180" check --replay exact.flr
runs "inputs of corner, .*ticks 0 to 180.*simulated" replay in.flr --check
runs "All 181 ticks .* are equal" diff a.flr b.flr
runs "are equal within 2.1 mm" diff a.flr exact.flr --within 2.1
runs "are equal" diff in.flr exact.flr
refuses "part at tick 0: walker [0-9]+, .*(place|turn), .* (m|degrees)" diff a.flr other.flr
refuses "part at tick 0: walker" diff a.flr exact.flr

# A byte that flipped, one after the other; a file that was cut short.
size=$(stat -c %s a.flr)
for at in 3 9 14 100 $((size / 3)) $((size / 2)) $((size - 300)); do
    cp a.flr flipped.flr
    printf '\xa5' | dd of=flipped.flr bs=1 seek="$at" conv=notrunc status=none
    cmp -s a.flr flipped.flr && continue
    status=0
    "$flaneur" replay flipped.flr --check > said 2>&1 || status=$?
    ((status <= 1)) || failed "byte $at flipped ends with $status"
    ((status == 1)) || grep -qE "left out|ticks 0 to 180" said || failed "byte $at flipped"
done
for share in 30 60 95; do
    head -c $((size * share / 100)) a.flr > cut.flr
    runs "ticks 0 to [0-9]+.*" replay cut.flr --check
    grep -q "not finished" said || failed "cut.flr is not finished"
done
head -c 700 a.flr > cut.flr
refuses "cut short" replay cut.flr --check
echo "nothing" > no.flr
refuses "no.flr is no recording" replay no.flr --check
refuses "no.flr is no recording" diff a.flr no.flr

# The city of its scene has gone.
cp "$here/../small.osm" here.osm
runs "Recorded map.flr" sim --city here.osm --walkers 5 --seconds 1 --record map.flr --record-as inputs
rm here.osm
refuses "here.osm" replay map.flr --check

[[ -n $vulkan ]] || exit 0
small=(--size 320x180)
render=(render --scene corner --walkers 30 --frames 150 "${small[@]}")
runs "Wrote live.png" "${render[@]}" --out live.png
for file in exact in; do
    runs "Wrote $file.png" replay $file.flr --frames 150 "${small[@]}" --out $file.png
    cmp live.png $file.png || failed "$file.flr looks otherwise"
done
refuses "has ticks 0 to 180" replay a.flr --frames 500 "${small[@]}" --out late.png
if type ffmpeg > /dev/null 2>&1; then runs "Wrote out.mp4" replay a.flr --seconds 1:1.2 "${small[@]}" --out out.mp4; fi
