#!/bin/bash
# pictures.sh FLANEUR: a picture, numbered pictures and a film have the size and length that was asked for; a strip has twelve
# pictures in a row, or is a film, a sheet of people a cell for each.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
probe() { ffprobe -v error -count_frames -show_entries "stream=$1" -of csv=p=0 "$2"; }
expect() { if [[ $1 != "$2" ]]; then echo "FAILED: '$1' instead of '$2'" && exit 1; fi; }

"$1" render --scene corner --frames 30 --size 321x181 --camera overview --out one/city.png
expect "$(probe width,height one/city.png)" 321,181
"$1" render --scene corner --frames 0:4:2 --size 64x48 --camera follow:3 --out many/%04d.png
expect "$(echo many/*)" "many/0000.png many/0002.png many/0004.png"
"$1" render --scene corner --frames 0:20:2 --size 65x48 --camera 0,30,40/0,0,0 --out city.mp4
expect "$(probe width,height,r_frame_rate,nb_read_frames city.mp4)" 66,48,30/1,11
"$1" gait --stairs up --strip strip.png --view side > /dev/null
expect "$(probe width,height strip.png)" 2880,420
"$1" gait --stairs up --strip later.png --moments 12:14 > /dev/null
"$1" gait --strip abreast.png --abreast > /dev/null
"$1" gait --strip change.png --change 3 --moments 6:7 > /dev/null
"$1" gait --strip same.png --moments 6:7 > /dev/null
expect "$(probe width,height abreast.png)" 2880,420
"$1" gait --strip walk.mp4 --moments 6:6.5 > /dev/null
expect "$(probe width,height,r_frame_rate,nb_read_frames walk.mp4)" 480,840,30/1,15
"$1" gait --strip twelve.mp4 --abreast --moments 6:6.1 > /dev/null
expect "$(probe width,height,nb_read_frames twelve.mp4)" 2880,420,3
"$1" gait --stand 12 --strip stands.png --moments 5:7 > /dev/null
"$1" gait --stand 12 --aside 0.4 --strip aside.png --moments 5:7 > /dev/null
"$1" gait --stand 12 --turn 120 --strip spot.png --moments 5:7 > /dev/null
for pair in "strip later" "change same" "abreast same" "stands aside" "stands spot" "aside spot"; do
    read -r a b <<< "$pair"
    if cmp -s "$a.png" "$b.png"; then echo "FAILED: $a.png and $b.png are one picture." && exit 1; fi
done
"$1" people --count 2 --sheet sheet.png --size 130x120 > /dev/null
"$1" people --count 2 --sheet faces.png --size 130x120 --close > /dev/null
"$1" people --count 2 --sheet backs.png --size 130x120 --turn 180 > /dev/null
"$1" people --count 2 --sheet again.png --size 130x120 --turn 0 > /dev/null
expect "$(probe width,height sheet.png)" 260,120
expect "$(probe width,height faces.png)" 260,120
if cmp -s sheet.png faces.png; then echo "FAILED: --close changes nothing." && exit 1; fi
if cmp -s sheet.png backs.png; then echo "FAILED: --turn changes nothing." && exit 1; fi
cmp sheet.png again.png
names="abreast.png again.png aside.png backs.png change.png city.mp4 faces.png later.png many one same.png sheet.png spot.png"
expect "$(echo *)" "$names stands.png strip.png twelve.mp4 walk.mp4"
