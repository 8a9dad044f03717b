#!/bin/bash
# window.sh FLANEUR: a window under Xvfb is resized, minimised, restored, steered and closed, and the validation layer
# has nothing to say about it. It obeys while it loads, loses no key and no picture, and draws nothing while minimised.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
# shellcheck source-path=SCRIPTDIR source=display.sh
. "$here/display.sh"

open_display 1024x768
for what in TitleFont MenuFont IconFont ResizeFont IconManagerFont; do echo "$what \"fixed\""; done > "$folder/twmrc"
printf 'RandomPlacement\nNoTitle\n"F4" = : all : f.delete\n' >> "$folder/twmrc"
LC_ALL=C twm -f "$folder/twmrc" &
manager=$!
children+=("$manager")

failed() { echo "FAILED: $*" && exit 1; }
cd "$folder"
"$1" view --validate --scene corner --size 400x300 2> >(tee said >&2) &
viewer=$!
children+=("$viewer")
window=$(timeout 120 xdotool search --sync --onlyvisible --name '^flaneur - ' | head -1)
for size in "640 360" "300 700" "1 1" "500 400"; do
    # shellcheck disable=SC2086
    xdotool windowsize "$window" $size sleep 0.5
done
xdotool windowminimize "$window"
until xwininfo -id "$window" | grep 'IsUnMapped'; do sleep 0.1; done
for _ in {1..40}; do
    title=$(xdotool getwindowname "$window")
    if [[ $title == "flaneur - 0 fps"* ]]; then break; fi
    sleep 0.25
done
[[ $title == "flaneur - 0 fps"* ]] || failed "a minimised window is drawn: $title"
xdotool windowmap "$window"
until xwininfo -id "$window" | grep 'IsViewable'; do sleep 0.1; done
xdotool windowfocus "$window" mousemove --window "$window" 200 150
for key in 2 3 Tab Tab space F12 1 F1 F1 l F2 F10 F11 F3 l minus equal equal period h h w a ctrl+p Down Up Escape; do
    xdotool key $key sleep 0.3
done
# Back and forth in time, and two runs side by side for a while.
for key in b comma ctrl+Left ctrl+Right alt+Left Home End ctrl+shift+Left n Escape; do xdotool key $key sleep 0.3; done
find_action() { xdotool key ctrl+p sleep 0.5 type --delay 60 "$1" && xdotool sleep 0.5 key Return; }
find_action "compare with another"
xdotool sleep 3 key 1 sleep 1 mousemove --window "$window" 350 200 sleep 0.3 click 1 sleep 1
find_action "end comparing"
xdotool sleep 1
xdotool mousemove --window "$window" 40 20 sleep 0.3 click 1 sleep 0.3 click 1 sleep 0.3  # Stop, Go
xdotool mousemove --window "$window" 250 200 sleep 0.3 click 1 sleep 0.3 key f sleep 0.5 key 1 sleep 0.3
for button in 1 2 3; do xdotool mousedown $button mousemove_relative 40 10 sleep 0.3 mouseup $button sleep 0.3; done
xdotool click 4 sleep 0.3 click 5 click 5 sleep 0.3
kill -0 $viewer $manager

# It is paused, since Space was pressed once: pictures of one tick, of which none is lost, after views went on and off
# by keys one at a time and by keys within one frame.
take() {  # FILE: a picture as FILE
    local before after
    before=$(find out -name 'view-*.png' | wc -l)
    xdotool sleep 1 key F12
    for _ in {1..80}; do
        after=$(find out -name 'view-*.png' | wc -l)
        if ((after > before)); then break; fi
        sleep 0.25
    done
    ((after == before + 1)) || failed "$((after - before)) pictures after F12"
    sleep 0.5
    cp "$(find out -name 'view-*.png' -printf '%T@ %p\n' | sort -n | tail -1 | cut -d' ' -f2)" "$1"
}
xdotool key 1
take plain.png
xdotool key F7 sleep 1 key F10 sleep 1 key F11
take apart.png
xdotool key F7 sleep 1 key F10 sleep 1 key F11 sleep 1
xdotool key --delay 0 F7 F10 F11
take together.png
if cmp --silent plain.png apart.png; then failed "views change nothing"; fi
cmp apart.png together.png || failed "keys pressed within one frame are lost"
# The command that C copies, and that the picture holds, draws the picture.
xdotool key c
for _ in {1..40}; do if grep --quiet '^flaneur render' said; then break; fi; sleep 0.25; done
command=$(grep '^flaneur render' said | tail -1)
grep --quiet --text --fixed-strings "$command" together.png || failed "the picture does not hold its command"
"$1" render --like together.png --out again.png
"$here/../pictures/differ.py" together.png again.png 0
# A film of steps, and the next city in the same window; a scene that cannot be read changes nothing.
xdotool key r sleep 2 key r
for _ in {1..80}; do if grep --quiet '^Wrote out/film-.*mp4' said; then break; fi; sleep 0.25; done
ffprobe -loglevel error "$(find out -name 'film-*.mp4')" || failed "the film is not whole"
echo '{"walkers": -1}' > bad.json
echo '{"walkers": 5, "blocks": 1, "camera": "overview"}' > good.json
open_typed() {  # FILE SAID
    xdotool key ctrl+o sleep 2 type "$1"  # in the folder that it begins with
    xdotool sleep 2 key Return
    for _ in {1..160}; do if grep --quiet "$2" said; then return; fi; sleep 0.25; done
    failed "no word of $1"
}
open_typed bad.json '^bad.json cannot be opened'
xdotool key Escape
open_typed good.json '^good.json is open'
[[ $(xdotool sleep 2 getwindowname "$window") == *' 5 walkers '* ]] || failed "the scene is not shown"
xdotool windowfocus "$window"
rm -r out && touch out
xdotool key F12
for _ in {1..80}; do if grep --quiet 'Cannot write out/view-' said; then break; fi; sleep 0.25; done
grep --quiet 'Cannot write out/view-' said || failed "nothing is said of a picture that cannot be written"
rm out
sleep 0.5
kill -0 $viewer || failed "a picture that cannot be written ends the program"
xdotool windowfocus "$window" mousemove --window "$window" 100 100 key F4
timeout 60 tail --pid=$viewer --follow /dev/null
wait $viewer

# It obeys while it loads, and afterwards: what ends it, with which status. A machine may be busy once; who is slow is
# slow three times.
loading() {  # FLANEUR STATUS WHEN-TITLE WORDS...: the words end it
    local took
    for again in 1 2 3; do
        loading_once "$@"
        if ((took < 2000)); then return; fi
        if ((again < 3)); then rm -rf "$folder/none"; fi
    done
    failed "$took ms after ${*:4}"
}
loading_once() {
    local status=0 start
    XDG_CACHE_HOME=$folder/none "$1" view --scene square --walkers 3000 --size 400x300 &
    viewer=$!
    window=$(timeout 120 xdotool search --sync --onlyvisible --name "$3" | head -1)
    xdotool windowfocus "$window" mousemove --window "$window" 100 100
    start=${EPOCHREALTIME/./}
    "${@:4}"
    wait $viewer || status=$?
    took=$(((${EPOCHREALTIME/./} - start) / 1000))
    ((status == $2)) || failed "status $status after ${*:4}"
    if [[ $3 == 'flaneur: '* && -n $(find "$folder" -name '*.part') ]]; then failed "something half-written is left"; fi
}
rm -rf "$folder/none"
end_viewer() { kill -TERM $viewer; }
loading "$1" 143 'flaneur: ' end_viewer
loading "$1" 143 'flaneur - ' end_viewer
rm -rf "$folder/none"
for way in "xdotool key Escape" "xdotool key F4"; do
    # shellcheck disable=SC2086
    loading "$1" 0 'flaneur: ' $way
done

"$1" view --validate --scene corner --size 320x200 --frames 5

# What it takes at rest and moving, with panels and without.
"$1" bench window --validate --scene corner --size 320x200 --frames 2 --json "$folder/paces.json"
python3 - "$folder/paces.json" << 'END'
import json, sys
paces = json.load(open(sys.argv[1]))
names = [one["name"] for one in paces["benchmarks"] if one["iterations"] == 2 and one["real_time"] > 0]
assert names == ["at rest", "at rest, panels", "moving", "moving, panels"], paces
assert 0 < paces["counts"]["at rest, panels, percent of the window's pixels each way"] <= 100, paces
END
