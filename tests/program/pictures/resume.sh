#!/bin/bash
# resume.sh FLANEUR: a film and numbered pictures that were given up on are gone on with, and are as if they never had been.
set -euo pipefail
flaneur=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failed() { echo "FAILED: $*" && exit 1; }
render() { "$flaneur" render --scene corner --walkers 20 --size 97x64 --camera follow:3 "$@" 2> said; }
pictures() { ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 "$1"; }

render --frames 0:40:4 --out many/%03d.png
cp -r many whole
rm many/01[26].png many/040.png
touch -d 2001-01-01 many/*
render --frames 0:40:4 --out many/%03d.png --resume
diff -r many whole || failed "other pictures"
[[ $(find many -newermt 2002-01-01 | grep -c png) == 3 ]] || failed "drew again what was there"

render --frames 0:40:4 --out whole.mp4
film="it's 100% half.mp4"
render --frames 0:16:4 --out "$film"
render --frames 0:40:4 --out "$film" --resume
[[ $(pictures "$film") == 11 ]] || failed "$(pictures "$film") pictures in the film"
# Coded anew from where it went on, so no more than alike.
alike=$(ffmpeg -v info -i "$film" -i whole.mp4 -lavfi psnr -f null - 2>&1 | sed -n 's/.*PSNR.*min:\([0-9a-z]*\).*/\1/p')
[[ $alike == inf || $alike -ge 30 ]] || failed "$alike dB apart"
cp "$film" before.mp4
render --frames 0:40:4 --out "$film" --resume
cmp "$film" before.mp4 || failed "a whole film was changed"
[[ -s said ]] && ! grep -q -i error said || failed "$(cat said)"

if render --frames 0:40:5 --out "$film" --resume; then failed "went on at another rate"; fi
grep -q "Cannot go on with .*15 pictures a second" said || failed "$(cat said)"
cmp "$film" before.mp4 || failed "a refused film was changed"
if render --frames 7 --out one.png --resume; then failed "went on with one picture"; fi
[[ $(find . -name '*.part' -o -name '.flaneur*') == "" ]] || failed "parts are left"
