#!/bin/bash
# same_picture.sh FLANEUR: two runs, with different numbers of threads, write the same bytes.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for threads in 1 3; do
    "$1" render --scene corner --frames 60:90:30 --size 480x270 --threads $threads --out "$folder/$threads/%03d.png"
done
for tick in 060 090; do cmp "$folder/1/$tick.png" "$folder/3/$tick.png"; done
if cmp --silent "$folder/1/060.png" "$folder/1/090.png"; then echo "FAILED: nothing moves." && exit 1; fi
