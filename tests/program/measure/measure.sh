#!/bin/bash
# measure.sh FLANEUR: what `flaneur measure` tells and writes of two people who walk through a corridor at 1 m/s, 2 m apart, and
# of a run of ours.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
{
    echo "# framerate: 10"
    echo "# id frame x/m y/m z/m"
    for frame in $(seq 0 100); do
        echo "1 $frame $(printf '%d.%d' $((frame / 10)) $((frame % 10))) 1 0"
        echo "2 $frame $(printf '%d.%d' $((frame / 10 + 2)) $((frame % 10))) 1 0"
    done
} > "$folder/two.txt"
"$1" measure "$folder/two.txt" --walkable '0,0 12,2' --area '3,0 7,2' --line 'gate:5,0 5,2' --passing 1 --out "$folder/two" > "$folder/told"
grep --quiet 'two.txt: 2 people, 202 places, frames 0 to 100 at 10 a second' "$folder/told"
grep --quiet 'line gate of 2.00 m' "$folder/told"
python3 - "$folder/two" << 'END'
import csv, json, math, sys, xml.dom.minidom, glob
folder = sys.argv[1]
def rows(name):
    return list(csv.DictReader(open(f"{folder}/{name}.csv")))
area = rows("area")[40]  # people at 4 and at 6, each with 2 m2 of the area's 8 at least
assert area["people"] == "2" and abs(float(area["density_classic_per_m2"]) - 0.25) < 1e-4, area
assert abs(float(area["speed_mean_m_per_s"]) - 1) < 1e-3, area
crossings = rows("line-gate")
assert [(c["id"], round(float(c["time_s"]), 2), c["to_left"]) for c in crossings] == [("2", 3.0, "0"), ("1", 5.0, "0")], crossings
assert [float(p["speed_m_per_s"]) for p in rows("line-gate-passing")] == [1, 1] or len(rows("line-gate-passing")) == 2
assert all(abs(float(d["seconds"]) - 4) < 0.11 for d in rows("dwell")) and len(rows("dwell")) == 2, rows("dwell")
person = rows("individual")[80]
assert abs(float(person["nearest_m"]) - 2) < 1e-3 and person["ttc_s"] == "", person
tables = json.load(open(f"{folder}/measures.json"))["tables"]
assert tables["line-gate-nt"]["cumulative_pedestrians"] == [1, 2], tables["line-gate-nt"]
charts = glob.glob(f"{folder}/*.svg")
assert len(charts) == 7, charts
for chart in charts:
    xml.dom.minidom.parse(chart)
END
"$1" measure "$folder/two.txt" --walkable '0,0 12,2' --voronoi --out "$folder/one.csv" > /dev/null
[[ -s "$folder/one-area.csv" && ! -e "$folder/one-individual.csv" ]] || { echo "FAILED: one-area.csv alone"; exit 1; }
"$1" sim --scene corner --seconds 3 --trajectories "$folder/corner.sqlite" > /dev/null
"$1" measure "$folder/corner.sqlite" --out "$folder/corner.svg" | grep --quiet 'area of'
