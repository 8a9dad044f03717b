#!/bin/bash
# trace.sh FLANEUR VULKAN: --trace of 300 frames is whole and true (trace.py), of a run that is interrupted too.
set -euo pipefail
flaneur=$1 vulkan=$2
check=$(dirname "$(realpath "$0")")/trace.py
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$flaneur" sim --scene corner --walkers 400 --threads 2 --seconds 5 --trace sim.json
python3 "$check" sim.json 300
"$flaneur" bench crowd --scene corner --walkers 400 --threads 2 --frames 300 --trace crowd.json > printed
python3 "$check" crowd.json 300
if [[ $vulkan == ON ]]; then
    "$flaneur" bench frame --scene corner --walkers 40 --threads 2 --size 320x180 --frames 300 --trace frame.json > printed
    python3 "$check" frame.json 300 device
    "$flaneur" render --scene corner --walkers 40 --threads 2 --size 320x180 --frames 0:30 --out %d.png --trace render.json
    python3 "$check" render.json 31 device
fi

# Ctrl-C, while the program is at it: what there is by then.
env --default-signal=INT "$flaneur" sim --scene corner --walkers 400 --threads 2 --seconds 100000 --trace cut.json 2> said &
pid=$!
for ((i = 0; i < 600; ++i)); do
    if grep --quiet simulating said || ((i > 40)); then break; fi
    sleep 0.1
done
kill -INT $pid
status=0
wait $pid || status=$?
((status == 130)) || { cat said && echo "FAILED: status $status" && exit 1; }
python3 - << 'END'
import json
events = json.load(open("cut.json", encoding="utf-8"))["traceEvents"]
assert sum(event["name"] == "frame" for event in events) > 10, "FAILED: no frames in a trace that was cut short"
END
# Nothing is recorded unasked.
"$flaneur" sim --scene corner --walkers 4 --seconds 1
[[ $(ls) != *trace* ]]
