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
mkfifo pipe pipe.mp4
cat pipe > piped &
picture pipe
wait
for other in dash stdout piped; do cmp a.png "$other"; done
[[ -p pipe ]]

"$flaneur" render --scene corner --walkers 5 --size 64x64 --out unsaid.png 2>&-
cmp a.png unsaid.png
mkdir "odd dir"
"$flaneur" render --scene corner --walkers 5 --size 64x64 --frames 6 --out "odd dir/%d.png" 2> said
grep --quiet '^Wrote odd dir/6.png$' said
# A film is refused before anybody waits for a reader.
if timeout 20 "$flaneur" render --out pipe.mp4 2> said; then echo "FAILED: a film in a pipe" && exit 1; fi
grep --quiet 'A film takes a plain file' said
# What is refused leaves no folder, of several files neither.
if "$flaneur" bench peers --character nobody.glb --out new/folder 2> said; then echo "FAILED: nobody dances" && exit 1; fi
[[ ! -e new ]]

"$flaneur" city --scene corner --out town.glb
"$flaneur" city --scene corner --out - | cmp - town.glb
"$flaneur" city --scene corner --out /dev/null
sheet() { "$flaneur" people --count 1 --size 64x64 --sheet "$1"; }
sheet sheet.png > table
sheet - 2> said | cmp - sheet.png
grep --quiet --file=table said
