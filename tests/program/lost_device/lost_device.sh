#!/bin/bash
# lost_device.sh FLANEUR LAYERS: a window whose device is lost, as when a driver resets a GPU, goes on with one that is
# made anew, and says so; a picture that is drawn without a window fails in a sentence.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed() { echo "FAILED: $*" && cat "$folder/said" && exit 1; }
export XDG_STATE_HOME=$folder/state XDG_CONFIG_HOME=$folder/config
export VK_LAYER_PATH=$2 VK_INSTANCE_LAYERS=VK_LAYER_FLANEUR_lost_device
unset WAYLAND_DISPLAY
cd "$folder"
# While it loads, as it takes the city, and while it shows people.
for at in LOST_AT=25 LOST_INDICES=1000000 LOST_AT=150; do
    env "$at" xvfb-run -a -s "-noreset -screen 0 640x480x24" \
        "$1" view --scene corner --walkers 50 --size 320x200 --frames 200 > said 2>&1 || failed "the window ends"
    grep --quiet "device was lost" said || failed "no device was lost: this test has tested nothing"
done
if LOST_AT=12 "$1" render --scene corner --walkers 10 --frames 0:20 --out "%03d.png" 2> said; then
    failed "a lost device is not told"
fi
grep --quiet "device was lost" said || failed "a lost device is not told"
