#!/bin/bash
# streams.sh FLANEUR: a picture is written to standard output and to a pipe as it is to a file, and so is a city; what else
# is printed does not mix with them.
set -euo pipefail
flaneur=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
picture() { "$flaneur" render --scene corner --walkers 5 --size 64x64 --out "$1" 2> /dev/null; }
picture a.png
picture - > dash
picture /dev/stdout | cat > stdout
mkfifo pipe
cat pipe > piped &
picture pipe
wait
for other in dash stdout piped; do cmp a.png "$other"; done
[[ -p pipe ]]

"$flaneur" city --scene corner --out town.glb
"$flaneur" city --scene corner --out - | cmp - town.glb
"$flaneur" city --scene corner --out /dev/null
sheet() { "$flaneur" people --count 1 --size 64x64 --sheet "$1"; }
sheet sheet.png > table
sheet - 2> said | cmp - sheet.png
grep --quiet --file=table said
