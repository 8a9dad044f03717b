#!/bin/bash
# aarch64_walk.sh FLANEUR FOLDER: FLANEUR and the one that aarch64.sh built in FOLDER walk one person in the same poses,
# bit for bit: on the level, through a half turn, up stairs and up a slope. Skips, with 77, where aarch64.sh could not
# build what it takes.
set -euo pipefail
flaneur=$1 folder=$2
if [[ ! -x $folder/flaneur ]]; then
    echo "SKIPPED: there is no build for aarch64; whole.build_aarch64 says why."
    exit 77
fi
for words in "--speed 1.3 --seconds 12" "--turn 180" "--stairs up" "--slope 8"; do
    # shellcheck disable=SC2086
    here=$("$flaneur" gait $words | grep '^Poses ') there=$("$folder/flaneur" gait $words | grep '^Poses ')
    echo "gait $words: $here here, $there on aarch64"
    [[ $here =~ ^Poses\ [0-9a-f]{16}\.$ && $here == "$there" ]]
done
