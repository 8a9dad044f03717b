#!/bin/bash
# window.sh FLANEUR: a window under Xvfb is resized, minimised, restored, steered and closed, and the validation layer
# has nothing to say about it.
set -euo pipefail
folder=$(mktemp -d)
children=()
finish() {
    for child in "${children[@]}"; do kill "$child" 2> /dev/null || true; done
    wait
    rm -rf "$folder"
}
trap finish EXIT

exec 3> "$folder/display"
Xvfb -displayfd 3 -screen 0 1024x768x24 -nolisten tcp -noreset 2> "$folder/xvfb" &
children+=($!)
for _ in {1..100}; do if [[ -s $folder/display ]]; then break; fi; sleep 0.1; done
DISPLAY=:$(cat "$folder/display")
export DISPLAY
unset WAYLAND_DISPLAY
for what in TitleFont MenuFont IconFont ResizeFont IconManagerFont; do echo "$what \"fixed\""; done > "$folder/twmrc"
printf 'RandomPlacement\nNoTitle\n"F4" = : all : f.delete\n' >> "$folder/twmrc"
LC_ALL=C twm -f "$folder/twmrc" &
manager=$!
children+=("$manager")

cd "$folder"
"$1" view --validate --scene corner --size 400x300 &
viewer=$!
children+=("$viewer")
window=$(timeout 120 xdotool search --sync --onlyvisible --name '^flaneur - ' | head -1)
for size in "640 360" "300 700" "1 1" "500 400"; do
    # shellcheck disable=SC2086
    xdotool windowsize "$window" $size sleep 0.5
done
xdotool windowminimize "$window"
until xwininfo -id "$window" | grep 'IsUnMapped'; do sleep 0.1; done
sleep 0.5
xdotool windowmap "$window"
until xwininfo -id "$window" | grep 'IsViewable'; do sleep 0.1; done
xdotool windowfocus "$window" mousemove --window "$window" 200 150
for key in 2 3 Tab Tab space F12 1 F1 F2 F10 F11 F3 w a; do xdotool key $key sleep 0.3; done
xdotool mousedown 1 mousemove_relative 40 10 sleep 0.3 mouseup 1 sleep 0.3
kill -0 $viewer $manager
xdotool windowfocus "$window" mousemove --window "$window" 100 100 key F4
timeout 60 tail --pid=$viewer --follow /dev/null
wait $viewer
pictures=(out/view-*.png)
[[ -s ${pictures[0]} ]]

"$1" view --validate --scene corner --size 320x200 --frames 5
