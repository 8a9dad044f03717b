#!/bin/bash
# study.sh FLANEUR LOAD PATTERN WORDS...: `FLANEUR bench LOAD WORDS` prints the pattern, and writes JSON and a whole SVG.
set -euo pipefail
flaneur=$1 load=$2 pattern=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$flaneur" bench "$load" "$@" --json "$folder/figures.json" --svg "$folder/chart.svg" | tee "$folder/table"
grep --quiet -E "$pattern" "$folder/table"
python3 - "$folder" <<'PYTHON'
import json
import sys
import xml.etree.ElementTree as tree

folder = sys.argv[1]
figures = json.load(open(folder + "/figures.json"))
assert figures["setting"] and (figures.get("points") or figures.get("ablations")), figures
svg = tree.parse(folder + "/chart.svg").getroot()
assert svg.tag.endswith("svg") and len(list(svg.iter())) > 20
PYTHON
