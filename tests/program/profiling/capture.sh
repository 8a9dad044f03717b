#!/bin/bash
# capture.sh FLANEUR: RenderDoc captures the picture that was asked for, and it is as without; what reads captures finds
# our passes and names in it, and the same picture when it is replayed. In a window Ctrl+F12 captures what is shown.
set -euo pipefail
flaneur=$1
for program in renderdoccmd Xvfb xdotool; do
    command -v $program > /dev/null || { echo "SKIPPED: $program is not installed." && exit 77; }
done
replay=$(dirname "$(realpath "$0")")/replay.py
python=/usr/bin/python3  # which packages of modules are for
# shellcheck source-path=SCRIPTDIR source=../window/display.sh
. "$(dirname "$replay")/../window/display.sh"
cd "$folder"
failed() { echo "FAILED: $*" && exit 1; }

draw() { "$flaneur" render --scene corner --walkers 40 --size 320x180 --light "$1" "${@:2}"; }
for light in host device; do
    draw $light --frames 0:10:5 --out $light/%02d.png
    draw $light --frames 0:10:5 --out $light/with/%02d.png --capture 5 2> said
    grep --quiet "^Captured $light/with/05.rdc" said || failed "nothing is said of a capture: $(cat said)"
    [[ $(cd $light/with && echo *) == "00.png 05.png 05.rdc 10.png" ]] || failed "$light/with has $(ls -A $light/with)"
    for picture in 00 05 10; do
        cmp $light/$picture.png $light/with/$picture.png || failed "RenderDoc changes picture $picture"
    done
    renderdoccmd convert -f $light/with/05.rdc -o $light.xml -c xml
    for name in "crowd shadows" scene "shadow maps" picture "pictures of scenery"; do
        grep --quiet -F ">$name" $light.xml || failed "a capture has no $name"
    done
    if $python "$replay" 2> /dev/null; then
        $python "$replay" $light/with/05.rdc picture replayed.png
        python3 "$(dirname "$replay")/../pictures/differ.py" replayed.png $light/05.png 0
    else
        echo "LEFT OUT: python3-renderdoc is not installed, which replays captures."
    fi
done
draw host --frames 0:4:2 --out film.mp4 --capture 2
[[ -s film-2.rdc ]] || failed "there is $(ls) of a film"

open_display 800x600
# press OPTION...: Ctrl+F12 in a window; what is said goes into the file `told`.
press() {
    "$flaneur" view --scene corner --walkers 40 --size 320x180 "$@" 2> told &
    local viewer=$! window
    children+=($viewer)
    window=$(timeout 120 xdotool search --sync --onlyvisible --name '^flaneur - ' | head -1)
    xdotool windowfocus "$window" sleep 0.5
    # With a renderer that was made anew.
    xdotool key ctrl+p sleep 0.5 type --delay 60 "quality: low" && xdotool sleep 0.5 key Return sleep 2
    xdotool key --clearmodifiers ctrl+F12
    for _ in {1..200}; do if grep --quiet -E '^(Captured|RenderDoc)' told; then break; fi; sleep 0.1; done
    cat told
    xdotool key ctrl+q
    wait $viewer || failed "the window ended with status $?"
}
press --capture
[[ $(ls out) =~ ^view-[0-9]+.rdc$ ]] || failed "the window captured $(ls -A out)"
grep --quiet "^Captured out/$(ls out)" told
renderdoccmd thumb out/view-*.rdc -o thumb.png -f png
[[ $(od -A n -t x1 -j 16 -N 8 thumb.png) == " 00 00 01 40 00 00 00 b4" ]] || failed "it is not of a picture of 320 x 180"
rm -r out
press
grep --quiet 'start with `flaneur view --capture`' told || failed "it is not said how RenderDoc is loaded"
[[ ! -e out ]] || failed "a capture without RenderDoc"
