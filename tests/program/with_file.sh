#!/bin/bash
# with_file.sh FILE COMMAND...: runs COMMAND with FILE as its last word. Skips, with 77, where FILE is not there.
set -euo pipefail
if [[ ! -e $1 ]]; then echo "SKIPPED: $1 is not here, so $(basename "$2") was not run on it." && exit 77; fi
exec "${@:2}" "$1"
