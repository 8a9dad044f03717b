#!/bin/bash
# sweep.sh FLANEUR FARM: a sweep has a row for each combination of values, with the hash that the run has alone; what is there
# already is not run again.
set -euo pipefail
flaneur=$1 farm=$2
type parallel > /dev/null 2>&1 || { echo "SKIPPED: parallel is not installed" && exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failed() { echo "FAILED: $*" && cat said && exit 1; }
sweep() { "$farm" sweep "$@" -- "$flaneur" sim --scene corner --seconds 2 --hash --line gate:3,-4/8,-4 > said 2>&1; }

sweep --seeds 1:3:2 --walkers 5,10 --csv t.csv || failed "it ends with $?"
[[ $(head -n 1 t.csv) == seed,walkers,people,ticks,wall_s,hash,said ]] || failed "$(head -n 1 t.csv)"
(($(wc -l < t.csv) == 5)) || failed "$(cat t.csv)"
for seed in 1 3; do
    for walkers in 5 10; do
        hash=$("$flaneur" sim --scene corner --seconds 2 --hash --seed $seed --walkers $walkers 2> /dev/null)
        grep -qE "^$seed,$walkers,$walkers,120,[0-9.]+,$hash,\"gate: [0-9]+ to the left" t.csv || failed "$seed, $walkers: $(cat t.csv)"
    done
done
touch -d 2001-01-01 t.csv.runs/*/*.done
sweep --seeds 1:3:2 --walkers 5,10,15 --csv t.csv || failed "it ends with $?"
(($(wc -l < t.csv) == 7)) || failed "$(cat t.csv)"
(($(find t.csv.runs -name '*.done' -newermt 2002-01-01 | wc -l) == 2)) || failed "what was there is run again"

# refuses PATTERN WORDS...
refuses() {
    if "$farm" "${@:2}" > said 2>&1; then failed "it takes ${*:2}"; fi
    grep -qE -- "$1" said || failed "${*:2} does not say $1"
}
refuses "say film or sweep" fly
refuses "the command comes after --" film
refuses "needs a value" sweep --seeds -- "$flaneur" sim
refuses "something that varies" sweep -- "$flaneur" sim
refuses "no program nobody" sweep --seeds 1:2 -- nobody sim
refuses "needs --out FILE.mp4" film -- "$flaneur" render --out a.png
refuses "film takes no --seeds|film takes no --seed" film --seeds 1:2 -- "$flaneur" render --out a.mp4
refuses "8x is not a whole number" film --parts 8x -- "$flaneur" render --out a.mp4
refuses "1 of 1 are not done after 1 tries" sweep --rounds 0 --walkers many -- "$flaneur" sim
"$farm" --help | grep -q -- "--seeds 1:8" || failed "no help"
