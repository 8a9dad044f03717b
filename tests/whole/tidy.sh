#!/bin/bash
# tidy.sh ROOT BUILD COMMITS: clang-tidy, and Clang's own warnings, over the sources that the last COMMITS commits changed, or
# over all where git cannot tell; those that nobody has changed since say what they said.
set -euo pipefail
cd "$1"
changed=$(git log --max-count="$3" --name-only --format= -- {sim,assets,renderer,tools}/'*.cpp' 2> /dev/null) ||
    changed=$(find sim assets renderer tools -name '*.cpp')
sort -u <<< "$changed" | while read -r file; do if [[ -f $file ]]; then echo "$file"; fi; done |
    xargs --no-run-if-empty --max-procs="$(nproc)" --max-args=4 clang-tidy --quiet -p "$2"
