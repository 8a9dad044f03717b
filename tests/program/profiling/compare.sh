#!/bin/bash
# compare.sh FLANEUR: `bench compare` passes two runs of the same, finds a stage that was made slower, and takes files of
# Google Benchmark's too; compare.py of libbenchmark-tools reads ours, where it is installed.
set -euo pipefail
flaneur=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for run in before real; do
    "$flaneur" bench crowd --scene corner --walkers 300 --threads 1 --frames 120 --json $run.json > printed
done
# Files of this program, with samples of a machine that is known: a stage's median, by 3 % now less and now more, and now
# and then half as much again.
python3 - << 'END'
import json, random
before = json.load(open("before.json", encoding="utf-8"))

def write(name, seed, slower=1.0):
    file = json.loads(json.dumps(before))
    chance = random.Random(seed)
    for stage in file["benchmarks"]:
        factor = slower if stage["name"] == "gait" else 1.0
        stage["samples"] = [factor * stage["real_time"] * chance.gauss(1, 0.03) * chance.choices((1, 1.5), (19, 1))[0]
                            for _ in stage["samples"]]
        stage["real_time"] *= factor
    json.dump(file, open(name, "w", encoding="utf-8"))

write("one.json", 1)
write("same.json", 2)
write("slower.json", 3, 1.3)
END
"$flaneur" bench compare one.json same.json | tee same.txt
grep --quiet '^Nothing is slower by 5 % or more' same.txt
status=0
"$flaneur" bench compare one.json slower.json > slower.txt 2> said || status=$?
cat slower.txt said
((status == 1))
grep --quiet -E '^gait .* SLOWER$' slower.txt
[[ $(grep -c SLOWER slower.txt) == 1 ]]
grep --quiet -E 'slower.json is slower than one.json: gait [23][0-9][.][0-9] %' said
# What this machine says of two real runs of the same depends on who else is at work on it: told, not judged.
"$flaneur" bench compare before.json real.json || echo "These two runs of the same differ: the machine was busy."
tool=${COMPARE_PY-/usr/share/benchmark/compare.py}
if [[ -f $tool ]] && python3 "$tool" --help > asked; then
    # It reads the medians.
    python3 "$tool" --no-color benchmarks one.json slower.json | tee theirs.txt
    grep --quiet -E '^gait +[+]0[.]3000 +' theirs.txt
else
    echo "LEFT OUT: libbenchmark-tools or python3-scipy is not installed."
fi
