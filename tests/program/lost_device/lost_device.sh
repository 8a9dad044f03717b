#!/bin/bash
# lost_device.sh FLANEUR LAYERS: a window whose device is lost, as when a driver resets a GPU, goes on with one that is
# made anew, and says so; a picture that is drawn without a window fails in a sentence.
set -euo pipefail
folder=$(mktemp -d)
children=()
finish() {
    for child in "${children[@]}"; do kill "$child" 2> /dev/null || true; done
    wait
    rm -rf "$folder"
}
trap finish EXIT
failed() { echo "FAILED: $*" && cat "$folder/said" && exit 1; }
export VK_LAYER_PATH=$2 VK_INSTANCE_LAYERS=VK_LAYER_FLANEUR_lost_device
exec 3> "$folder/display"
Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp -noreset 2> "$folder/xvfb" &
children+=($!)
for _ in {1..100}; do if [[ -s $folder/display ]]; then break; fi; sleep 0.1; done
DISPLAY=:$(cat "$folder/display")
export DISPLAY
unset WAYLAND_DISPLAY
cd "$folder"
for at in 40 150; do
    LOST_AT=$at "$1" view --scene corner --walkers 50 --size 320x200 --frames 200 2> said || failed "the window ends"
    grep --quiet "device was lost" said || failed "no device was lost: this test has tested nothing"
done
if LOST_AT=12 "$1" render --scene corner --walkers 10 --frames 0:20 --out "%03d.png" 2> said; then
    failed "a lost device is not told"
fi
grep --quiet "device was lost" said || failed "a lost device is not told"
