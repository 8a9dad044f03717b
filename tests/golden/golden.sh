#!/bin/bash
# golden.sh RENDERCHECK FLANEUR SUITE FOLDER: what flaneur draws is what it drew when the references were blessed. They are of
# one driver; elsewhere there is nothing to hold against, which is said. A page to look at goes into FOLDER.
set -euo pipefail
rendercheck=$1 flaneur=$2 suite=$3 reports=$4
key=$("$rendercheck" device | awk -F '\t' 'tolower($2) ~ /llvmpipe/ { print $1; exit }' || true)
if [[ -z $key ]]; then echo "SKIPPED: there is no llvmpipe here, of which the references are." && exit 77; fi
if [[ ! -d $(dirname "$suite")/golden/$key ]]; then
    echo "SKIPPED: there are no references of $key; docs/render-checks.md says how they are made." && exit 77
fi
exec "$rendercheck" run "$suite" --program "flaneur=$flaneur" --html "$reports/golden.html" --junit "$reports/golden.xml"
