#!/bin/bash
# aarch64_golden.sh FOLDER NAME: golden.sh's NAME has its hash from the flaneur that aarch64.sh built in FOLDER. Skips,
# with 77, where aarch64.sh could not build what it takes.
set -euo pipefail
if [[ ! -x $1/flaneur ]]; then
    echo "SKIPPED: there is no build for aarch64; whole.build_aarch64 says why."
    exit 77
fi
exec "$(dirname "$0")/../program/golden/golden.sh" "$1/flaneur" "$2"
