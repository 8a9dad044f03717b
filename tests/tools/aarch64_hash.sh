#!/bin/bash
# aarch64_hash.sh FLANEUR FOLDER WORDS...: FLANEUR and the one that aarch64.sh built in FOLDER print the same hash for
# `sim WORDS --hash`. Skips, with 77, where aarch64.sh could not build what it takes.
set -euo pipefail
flaneur=$1 folder=$2
shift 2
if [[ ! -x $folder/flaneur ]]; then
    echo "SKIPPED: there is no build for aarch64; whole.build_aarch64 says why."
    exit 77
fi
if [[ ! -e $folder/root/unfused ]]; then
    echo "SKIPPED: apt had no source of Recast, and Debian's arm64 build of it rounds differently."
    exit 77
fi
exec "$(dirname "$0")/same_hash.sh" "$flaneur" "$folder/flaneur" "$@" -- "$@"
