#!/bin/bash
# tracks.sh FLANEUR: a file of trajectories is shown as people with bodies, whole and by its middle; what it does not say
# rightly is told by options; what cannot be is refused.
set -euo pipefail
flaneur=$1
here=$(realpath "$(dirname "$0")")
# shellcheck source-path=SCRIPTDIR source=says.sh
. "$here/says.sh"
same() { "$here/../pictures/differ.py" "$1" "$2" 0; }  # but for what they say of themselves
# Three who walk 4 m to the east at 1.3 m/s, in centimetres, 10 times a second.
awk 'BEGIN { for (f = 0; f < 31; ++f) for (i = 1; i <= 3; ++i) printf "%d %d %.1f %.1f\n", i, f, 13 * f, 100 * i }' > walk.txt
small=(--size 96x64 --quality low)
"$flaneur" replay walk.txt --fps 10 --unit cm "${small[@]}" --out middle.png 2> said || failed "a picture"
grep --quiet 'walk.txt: 3 people on 3 ways' said || failed "nobody is told"
"$flaneur" replay walk.txt --fps 10 --unit cm "${small[@]}" --frames 90 --out ninety.png 2> said || failed "its 90th tick"
same middle.png ninety.png || failed "3 s of film do not have the tick 90 in the middle"
"$flaneur" replay walk.txt --fps 10 --unit cm "${small[@]}" --out walk.mp4 2> said || failed "a film"
frames=$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 walk.mp4)
((frames == 91)) || failed "$frames pictures of 3 s, every other tick"
"$flaneur" render --replay walk.txt --fps 10 --unit 0.01 "${small[@]}" --frames 90 --out other.png 2> said || failed "render"
same ninety.png other.png || failed "0.01 is not cm"
"$flaneur" replay walk.txt --fps 10 --unit m "${small[@]}" --frames 90 --out metres.png 2> said || failed "metres"
if same ninety.png metres.png > /dev/null 2>&1; then failed "--unit changes nothing"; fi
refuses 'flaneur inspect walk.txt' replay walk.txt --check
refuses '--unit parsec is none of m' replay walk.txt --unit parsec
refuses '--origin 3 is no place EAST,NORTH' replay walk.txt --origin 3
refuses 'neither fade nor step' replay walk.txt --enter leap
refuses 'nobody.txt' replay nobody.txt
refuses 'needs|requires' render --unit cm --out a.png
"$flaneur" sim --scene corner --walkers 5 --seconds 1 --record run.flr 2> said || failed "a recording"
refuses 'are for trajectories' replay run.flr --unit cm --out a.png
