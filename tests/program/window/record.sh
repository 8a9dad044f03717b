#!/bin/bash
# record.sh FLANEUR: a window under Xvfb records what goes on in it, balls that are thrown and time that goes back with it;
# what it has so far can be read meanwhile, inputs are repeated as they were, and another window shows it all.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
# shellcheck source-path=SCRIPTDIR source=display.sh
. "$here/display.sh"

open_display 1024x768
cd "$folder"
failed() { echo "FAILED: $*" && cat said && exit 1; }

# begin WORDS...: a window, $window of the process $viewer.
begin() {
    "$flaneur" "$@" --size 500x350 > said 2>&1 &
    viewer=$!
    children+=("$viewer")
    window=$(timeout 240 xdotool search --sync --onlyvisible --name '^flaneur - ' | head -1)
    xdotool windowfocus "$window" sleep 2
}
flaneur=$1
for as in motion inputs; do
    begin view --scene corner --walkers 30 --record $as.flr --record-as $as
    xdotool key shift+b sleep 1 key ctrl+Left sleep 1 key End sleep 1 key alt+b sleep 1
    # Somebody is followed and pushed.
    xdotool key 3 sleep 0.5 key p sleep 2
    "$flaneur" replay $as.flr --check > said 2>&1 || failed "$as is not read while it grows"
    xdotool key ctrl+q
    wait "$viewer" || failed "the window that records $as"
    "$flaneur" replay $as.flr --check > said 2>&1 || failed "$as is not repeated"
    begin replay $as.flr
    for key in End ctrl+Left Home comma period n space Escape; do xdotool key $key sleep 0.4; done
    kill -0 "$viewer" || failed "the window that shows $as"
    xdotool key ctrl+q
    wait "$viewer" || failed "the window that shows $as"
done
