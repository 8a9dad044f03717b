#!/bin/bash
# build.sh ROOT PRESET FOLDER ARGUMENTS...: configures a preset into a folder of its own and builds it.
set -euo pipefail
cd "$1"
cmake --preset "$2" -B "$3" "${@:4}"
cmake --build "$3"
