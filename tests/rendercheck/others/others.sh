#!/bin/bash
# others.sh RENDERCHECK WHICH FILE...: rendercheck guards a program that is not ours by a suite of ten lines: its pictures
# are blessed, pass again, and what is changed about them is found.
set -euo pipefail
rendercheck=$1 which=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
fail() { echo "FAILED: $*" && exit 1; }
need() { command -v "$1" > /dev/null || { echo "SKIPPED: $which takes $1, which is not installed ($2)." && exit 77; }; }
folder=$TMPDIR/others && mkdir "$folder"
cp "$here/$which.json" "$@" "$folder"
case $which in
    vkcube) need vkcube vulkan-tools && need Xvfb xvfb && need ffmpeg ffmpeg && cp "$here/vkcube.sh" "$folder" ;;
    triangle) need xvfb-run xvfb ;;
    imagemagick)
        need convert imagemagick
        convert -version 2> /dev/null | grep ImageMagick > /dev/null || { echo "SKIPPED: convert is not ImageMagick's (imagemagick)." && exit 77; }
        ;;
esac
[[ $(wc -l < "$folder/$which.json") -le 10 ]] || fail "the suite has more than ten lines"
suite=$folder/$which.json
"$rendercheck" run "$suite" --bless
"$rendercheck" run "$suite" --runs 2
# Another picture under the same name.
case $which in
    vkcube) sed -i 's/"50"/"52"/' "$suite" ;;
    triangle) sed -i 's/"30"/"30.5"/' "$suite" ;;
    imagemagick) sed -i 's/circle 160,120/circle 161,120/' "$suite" ;;
esac
status=0
"$rendercheck" run "$suite" || status=$?
[[ $status == 1 ]] || fail "a change was not seen: $status"
left=$(pgrep -f "$folder" || true)
[[ -z $left ]] || fail "something still runs: $left"
