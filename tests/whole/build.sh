#!/bin/bash
# build.sh ROOT PRESET FOLDER OPTIONS... [-- TARGETS...]: configures a preset into a folder of its own and builds it, or
# only the targets.
set -euo pipefail
cd "$1"
preset=$2 folder=$3
shift 3
options=()
while [[ $# -gt 0 && $1 != -- ]]; do options+=("$1") && shift; done
cmake --preset "$preset" -B "$folder" "${options[@]}"
if [[ $# -gt 0 ]]; then
    cmake --build "$folder" --target "${@:2}"
else
    cmake --build "$folder"
fi
