#!/bin/bash
# tidy.sh ROOT BUILD: clang-tidy, and Clang's own warnings, over the sources that BUILD compiles.
set -euo pipefail
cd "$1"
find sim assets renderer tools -name '*.cpp' | sort |
    xargs --max-procs="$(nproc)" --max-args=4 clang-tidy --quiet -p "$2"
