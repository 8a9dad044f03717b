#!/bin/bash
# tidy.sh ROOT BUILD COMMITS: clang-tidy, and Clang's own warnings, over the sources that the last COMMITS commits changed, or
# over all where git cannot tell; those that nobody has changed since say what they said. Each is looked at by itself, as
# one that is compiled together with others may take what they include.
set -euo pipefail
cd "$1"
build=$(realpath "$2")
alone=$(mktemp -d)
trap 'rm -rf "$alone"' EXIT
cmake --preset release -B "$alone" -DFLANEUR_BATCH=OFF > "$alone/log" || { cat "$alone/log" && exit 1; }
sed -i "s#$alone#$build#g" "$alone/compile_commands.json"  # where what is made as others are built lies
changed=$(git log --max-count="$3" --name-only --format= -- {sim,assets,renderer,tools}/'*.cpp' 2> /dev/null) ||
    changed=$(find sim assets renderer tools -name '*.cpp')
sort -u <<< "$changed" | while read -r file; do if [[ -f $file ]]; then echo "$file"; fi; done |
    xargs --no-run-if-empty --max-procs="$(nproc)" --max-args=4 clang-tidy --quiet -p "$alone"
