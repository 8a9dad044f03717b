#!/bin/bash
# by_hand.sh FLANEUR SCENE: a scene is driven by keys and mouse under Xvfb as hands would, while the validation layer
# looks on: somebody is clicked, followed, driven, pushed; views go on and off; what can be dragged is dragged. What hands
# do is seen: pictures of the moment before and after differ.
set -euo pipefail
flaneur=$1 scene=$2
here=$(realpath "$(dirname "$0")")
# shellcheck source-path=SCRIPTDIR source=display.sh
. "$here/display.sh"
failed() { echo "FAILED: $scene: $*" && exit 1; }

open_display 800x600
cd "$folder"
"$flaneur" view --validate --scene "$scene" --size 480x320 --quality low 2> >(tee said >&2) &
viewer=$!
children+=("$viewer")
window=$(timeout 120 xdotool search --sync --onlyvisible --name '^flaneur - ' | head -1)
xdotool windowfocus "$window" mousemove --window "$window" 240 160
keys() { for key in "$@"; do xdotool key "$key" sleep 0.2; done; }
hold() { xdotool keydown "$1" sleep "$2" keyup "$1" sleep 0.1; }  # KEY SECONDS
drag() { xdotool mousemove --window "$window" "$1" "$2" sleep 0.2 mousedown 1 sleep 0.1 mousemove_relative -- "$3" "$4" sleep 0.4 mouseup 1 sleep 0.2; }
taken=0
take() {  # a picture as 1.png, 2.png, ...
    taken=$((taken + 1))
    xdotool sleep 0.3 key F12
    for _ in {1..80}; do
        if (($(find out -name 'view-*.png' 2> /dev/null | wc -l) >= taken)); then break; fi
        sleep 0.25
    done
    sleep 0.5
    cp "$(find out -name 'view-*.png' -printf '%T@ %p\n' | sort -n | tail -1 | cut -d' ' -f2)" "$taken.png"
}
differ() { if cmp --silent "$1.png" "$2.png"; then failed "$3 changes nothing"; fi; }

keys space h
take
# Who is in the middle, or the nearest one, is asked about, followed and driven: up, to both sides, at a run, in a jump.
keys 3 space x
hold Up 1.2
hold Left 0.6
hold Right 0.6
xdotool keydown shift
hold Up 0.8
xdotool keyup shift
keys space
keys Escape shift+x Up Left Down shift+x Escape
keys p shift+p
keys space
take
differ 1 2 "driving"
# Views, rooms and the mouse.
keys F11 shift+F11 F10 F10 shift+F11 F11 h j Escape shift+t Escape t Escape h
for button in 2 3; do xdotool mousedown $button mousemove_relative 30 10 sleep 0.2 mouseup $button sleep 0.2; done
drag 240 160 60 -20
xdotool click 4 sleep 0.2 click 5 sleep 0.2
keys shift+j shift+j comma ctrl+Left ctrl+Right
take
differ 2 3 "the mouse"
kill -0 $viewer || failed "the program ended by itself"
xdotool windowfocus "$window" key ctrl+q
timeout 60 tail --pid=$viewer --follow /dev/null || failed "it does not close"
wait $viewer || failed "it ends with status $?"
