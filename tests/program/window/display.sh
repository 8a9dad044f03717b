# shellcheck shell=bash
# Sourced by tests of windows: a folder of their own, of which nothing is left, nor of the processes in `children`.
folder=$(mktemp -d)
export XDG_STATE_HOME=$folder/state XDG_CONFIG_HOME=$folder/config
children=()
finish() {
    for child in "${children[@]}"; do kill "$child" 2> /dev/null || true; done
    wait
    rm -rf "$folder"
}
trap finish EXIT

# open_display SIZE: a display of so many pixels, which DISPLAY names from now on.
open_display() {
    exec 3> "$folder/display"
    Xvfb -displayfd 3 -screen 0 "$1x24" -nolisten tcp -noreset 2> "$folder/xvfb" &
    children+=($!)
    for _ in {1..100}; do if [[ -s $folder/display ]]; then break; fi; sleep 0.1; done
    DISPLAY=:$(cat "$folder/display")
    export DISPLAY
    unset WAYLAND_DISPLAY
}
