#!/bin/bash
# compare.sh FLANEUR: `bench compare` passes two runs of the same, finds a stage that was made slower, and takes files of
# Google Benchmark's too; compare.py of libbenchmark-tools reads ours, where it is installed.
set -euo pipefail
flaneur=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# Runs in turns, each half of what is compared: whatever the machine does meanwhile meets both alike.
for turn in 1 2 3 4; do
    "$flaneur" bench crowd --scene corner --walkers 300 --threads 1 --frames 60 --json "$turn.json" > printed
done
python3 - << 'END'
import json
runs = [json.load(open(f"{turn}.json", encoding="utf-8")) for turn in (1, 2, 3, 4)]

def together(a, b):
    one = json.loads(json.dumps(runs[a]))
    for stage, other in zip(one["benchmarks"], runs[b]["benchmarks"]):
        assert stage["name"] == other["name"]
        # In turns too.
        stage["samples"] = [s for pair in zip(stage["samples"], other["samples"]) for s in pair]
    return one

def write(name, file):
    json.dump(file, open(name, "w", encoding="utf-8"))

before, after = together(0, 3), together(1, 2)
write("before.json", before)
# What the machine itself did between the runs is no matter here: the same samples, in another order.
same = json.loads(json.dumps(before))
for stage in same["benchmarks"]:
    stage["samples"] = stage["samples"][1::2] + stage["samples"][::2]
write("same.json", same)
slower = json.loads(json.dumps(same))
for stage in slower["benchmarks"]:
    if stage["name"] == "gait":
        stage["samples"] = [1.3 * s for s in stage["samples"]]
write("slower.json", slower)
write("real.json", after)
END
"$flaneur" bench compare before.json same.json | tee same.txt
grep --quiet '^Nothing is slower by 5 % or more' same.txt
status=0
"$flaneur" bench compare before.json slower.json > slower.txt 2> said || status=$?
cat slower.txt said
((status == 1))
grep --quiet -E '^gait .* SLOWER$' slower.txt
[[ $(grep -c SLOWER slower.txt) == 1 ]]
grep --quiet -E 'slower.json is slower than before.json: gait [23][0-9][.][0-9] %' said
# What this machine says of two real runs of the same depends on who else is at work on it: told, not judged.
"$flaneur" bench compare before.json real.json || echo "These two runs of the same differ: the machine was busy."
tool=${COMPARE_PY-/usr/share/benchmark/compare.py}
if [[ -f $tool ]]; then
    # It reads the medians, which only the samples of slower.json differ in.
    python3 - << 'END'
import json
slower = json.load(open("slower.json", encoding="utf-8"))
for stage in slower["benchmarks"]:
    if stage["name"] == "gait":
        stage["real_time"] *= 1.3
json.dump(slower, open("theirs.json", "w", encoding="utf-8"))
END
    python3 "$tool" --no-color benchmarks before.json theirs.json | tee theirs.txt
    grep --quiet -E '^gait +[+]0[.]3000 +' theirs.txt
else
    echo "LEFT OUT: libbenchmark-tools is not installed."
fi
