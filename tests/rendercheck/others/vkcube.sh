#!/bin/bash
# vkcube.sh FRAMES STAY.so OUT.png: the picture of vkcube after so many frames, on a screen that nobody sees. It turns by
# frames, not by time, and opens its window at 100,100.
set -euo pipefail
folder=$(mktemp -d)
Xvfb -displayfd 3 -screen 0 420x340x24 -nolisten tcp 3> "$folder/display" 2> /dev/null &
for _ in {1..200}; do if [[ -s $folder/display ]]; then break; fi && sleep 0.05; done
DISPLAY=:$(< "$folder/display")
export DISPLAY
STAYS=$folder/stays LD_PRELOAD=$2 vkcube --c "$1" --width 320 --height 240 --suppress_popups &
for _ in {1..400}; do if [[ -e $folder/stays ]]; then break; fi && sleep 0.05; done
ffmpeg -loglevel error -f x11grab -draw_mouse 0 -video_size 320x240 -i "$DISPLAY+100,100" -frames:v 1 -y "$3"
rm -r "$folder"
