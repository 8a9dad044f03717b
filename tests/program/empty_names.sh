#!/bin/bash
# empty_names.sh FLANEUR: a value that is empty, as of a variable that nobody set, is refused and not taken for none.
set -euo pipefail
refused() {
    if "$@" 2> said; then echo "FAILED: ${*:2} was not refused." && exit 1; fi
    grep --quiet 'is empty: give ' said || { cat said && exit 1; }
}
cd "$(mktemp -d)"
refused "$1" sim --city "" --seconds 0
refused "$1" sim --seconds 0 --hash-log ""
refused "$1" gait --json ""
refused "$1" people --count 1 --out ""
refused "$1" city --check --json ""
refused "$1" city --out ""
refused "$1" sim --seconds 0 --time ""
refused "$1" sim --seconds 0 --isa ""
refused "$1" bench ""
