#!/bin/bash
# characters.sh FLANEUR FILE...: the table of docs/characters.md, a row a file, from what `FLANEUR inspect` says.
set -euo pipefail
flaneur=$1
echo "| file | height, m | faces | joints | skins | triangles | notes |"
echo "|---|---|---|---|---|---|---|"
for file in "${@:2}"; do
    name=$(basename "$file")
    if ! said=$("$flaneur" inspect "$file" 2>&1); then
        echo "| $name | | | | | | refused: ${said#*"$file": } |"
        continue
    fi
    awk -v name="$name" '
        function rest() { sub(/^ *[^ ]+( [^ ]+)*  +/, ""); return $0 }
        /^height, m/ { height = rest(); next }
        /^ahead/ { faces = rest(); next }
        /^skins/ { skins = rest(); next }
        /^triangles/ { triangles = rest(); sub(/,.*/, "", triangles); next }
        /^joints/ { joints = 1; next }
        joints && /^  / { if (/made up by proportion/) { sub(/^ */, ""); sub(/  .*/, ""); made = made ", " $0 } else found++; next }
        joints && !/^Joints made up/ { notes = notes " " $0 }
        END {
            print "| " name " | " height " | " faces " | " found " found" (made ? "; made up: " substr(made, 3) : "") \
                " | " skins " | " triangles " |" notes " |"
        }' <<< "$said"
done
