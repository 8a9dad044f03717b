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
rm many/01[26].png
truncate -s 300 many/040.png
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
grep -q "it's 100% half.mp4 has them already" said || failed "wrote what was there: $(cat said)"
render --frames 0:20:4 --out many/%03d.png --resume
grep -q "many/%03d.png has them already" said || failed "wrote what was there: $(cat said)"
render --frames 0:20:4 --out "$film" --resume
cmp "$film" before.mp4 || failed "a film that goes on was changed"
[[ -s said ]] && ! grep -q -i error said || failed "$(cat said)"

# refuse PATTERN WORDS...: what another command began, or nobody knows who, is left as it is.
refuse() {
    if render "${@:2}" --resume; then failed "went on with another's: ${*:2}"; fi
    grep -q -- "Cannot go on with .*$1" said || failed "$(cat said)"
    cmp "$film" before.mp4 || failed "a refused film was changed"
    diff -r many whole || failed "refused pictures were changed"
}
refuse "it was begun with --frames from 0 by 4, not --frames from 0 by 5\\." --frames 0:40:5 --out "$film"
refuse "it was begun with --seed 1, --camera follow:3, not --seed 2, --camera overview\\." \
    --frames 0:80:4 --seed 2 --camera overview --out "$film"
refuse "with --scene corner, .*not --scene district, " --frames 0:80:4 --scene district --out "$film"
refuse "many/000.png: it was begun with --time 17:30, the scene's sun at .*, not --time 08:00" --frames 0:80:4 --time 08:00 --out many/%03d.png
refuse "with no --view, .*not --view trails" --frames 4:80:4 --view trails --out many/%03d.png
ffmpeg -v error -i "$film" -c copy -map_metadata -1 stripped.mp4
refuse "does not say which command began it" --frames 0:80:4 --out stripped.mp4
ffmpeg -v error -i "$film" -vf scale=32:32 scaled.mp4
refuse "32x32 at 15 pictures a second" --frames 0:80:4 --out scaled.mp4
ffmpeg -v error -i many/000.png many/044.png
cp many/044.png whole
refuse "many/044.png: it does not say" --frames 0:80:4 --out many/%03d.png
head -c -5 "$film" > damaged.mp4
refuse "damaged or no film" --frames 0:80:4 --out damaged.mp4
head -c 3000 "$film" > damaged.mp4
refuse "damaged or no film" --frames 0:80:4 --out damaged.mp4
# Of two that go on with one film, the one that comes second sees that it is another.
render --frames 0:16:4 --out rivals.mp4
cp rivals.mp4 first.mp4
"$flaneur" render --scene corner --walkers 20 --size 97x64 --camera follow:3 --frames 0:400:4 --out rivals.mp4 --resume 2> late &
late=$!
while [[ -z $(find . -name '.flaneur-*.part' -size +0) ]] && kill -0 $late 2> /dev/null; do sleep 0.02; done
cp before.mp4 between
mv between rivals.mp4
if wait $late; then failed "joined with another film"; fi
grep -q "it had 5 pictures and has 11 now" late || failed "$(cat late)"
cmp rivals.mp4 before.mp4
if render --frames 7 --out one.png --resume; then failed "went on with one picture"; fi
[[ $(find . -name '*.part' -o -name '.flaneur*') == "" ]] || failed "parts are left"
