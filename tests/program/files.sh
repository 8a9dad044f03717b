#!/bin/bash
# files.sh FLANEUR MANUAL MAP VULKAN [CHARACTER]: every key that a JSON or CSV of the program has is in docs/files.md, and every
# key that is there is written; numbers are numbers.
set -euo pipefail
flaneur=$1 manual=$2 map=$3 vulkan=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
{
    "$flaneur" bench crowd --scene corner --frames 2 --json "bench crowd.json"
    "$flaneur" bench pose --scene corner --frames 1 --json "bench pose.json"
    "$flaneur" bench city --scene corner --frames 1 --json "bench city.json"
    "$flaneur" bench sweep --scene corner --walkers 2:8 --frames 4 --warm-up 4 --json "bench sweep.json"
    "$flaneur" bench scale --scene corner --walkers 20 --threads 2 --frames 4 --warm-up 4 --json "bench scale.json"
    "$flaneur" sim --scene corner --seconds 0.2 --trace trace.json
    "$flaneur" gait --json gait.json --csv gait.csv
    "$flaneur" gait --crowd 60 --seconds 12 --json "gait+crowd.json"
    # Not all bars of prams are met.
    "$flaneur" gait --pram --check --speed 1.3 --json "gait+pram.json" || true
    "$flaneur" sim --scene corner --seconds 2 --line -9,0/9,0 --zone -9,-9/9,-9/9,9/-9,9 --measures "measures.csv"
    mv measures-L1.csv "measures of a line.csv"
    mv measures-Z1.csv "measures of a zone.csv"
    "$flaneur" sim --scene corner --seconds 0.2 --trajectories trajectories.csv
    "$flaneur" validate R1 --json validate.json
    "$flaneur" people --count 1 --out .
    "$flaneur" inspect person_01.glb --json "inspect of a character.json"
    "$flaneur" inspect "$map" --json "inspect of a map.json"
    if [[ $vulkan == ON ]]; then
        "$flaneur" bench frame --scene corner --size 64x36 --frames 1 --json "bench frame.json"
        "$flaneur" bench ablate --scene corner --size 64x36 --frames 1 --warm-up 4 --walkers 20 --json "bench ablate.json"
        "$flaneur" render --scene corner --size 64x36 --out picture.png --ids "render and view.png"
        "$flaneur" city --check --city "$map" --walkers 2 --seconds 1 --json "city check.json" || true
    fi
    if [[ -n ${5-} ]]; then
        "$flaneur" bench peers --character "$5" --count 2 --size 64x36 --frames 1 --json "bench peers.json"
    fi
} > printed.txt
python3 - "$manual" "$vulkan" << 'END'
import json, os, re, sys

manual, vulkan = sys.argv[1:]
drawn = {"bench ablate", "bench frame", "bench peers", "city check", "render and view"}

# What the manual lists: by section, keys of the JSON and columns of the CSV.
keys, columns, units, optional, section, kind = {}, {}, {}, set(), "", ""
for line in open(manual, encoding="utf-8"):
    if line.startswith("## "):
        section = line[3:].strip()
    elif line.startswith("| key |"):
        kind = keys
    elif line.startswith("| column |"):
        kind = columns
    elif line.startswith("| file |"):
        kind = {}
    elif row := re.match(r"\| `([^`]+)` \|([^|]*)\|", line):
        kind.setdefault(section, []).append(row[1])
        units[section, row[1]] = row[2].strip()
        # What not every machine tells.
        if "can be read" in line:
            optional.add((section, row[1]))

def leaves(value, path=""):
    if isinstance(value, dict) and value:
        for key, of in value.items():
            yield from leaves(of, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        yield path + "[]", None
        for item in value:
            if isinstance(item, (dict, list)):
                yield from leaves(item, path + "[]")
            else:
                yield path + "[]", item
    else:
        yield path, value

wrong = []
quantities = {"ms", "ns", "m", "people", "frames", "ticks", "repetitions", "MB", "MHz", "J", "us", "bytes", "`time_unit`"}
for name, listed in keys.items():
    file = name + ".json"
    # All that one may have is in no single file: NAME+OTHER.json are of its kind too.
    files = [file] + sorted(other for other in os.listdir(".") if other.startswith(name + "+"))
    # Only what is built with Vulkan draws, and peers need a character that dances.
    if name in drawn and (vulkan != "ON" or name == "bench peers") and not os.path.exists(file):
        continue
    patterns = {key: re.compile("[^.]+".join(map(re.escape, key.split("*")))) for key in listed}
    met = set()
    for path, value in (leaf for one in files for leaf in leaves(json.load(open(one, encoding="utf-8")))):
        inner = path.endswith("[]") and any(key.startswith(path + ".") for key in listed)
        by = [key for key in listed if patterns[key].fullmatch(path)]
        if not by and not inner:
            wrong.append(f"{file} has {path}, which the manual lacks")
        met.update(by)
        if isinstance(value, str) and re.fullmatch(r"-?[0-9.]+(e-?[0-9]+)?", value):
            wrong.append(f"{file}: {path} is a number in quotes: {value}")
        for key in by:
            if units[name, key] in quantities and value is not None and not isinstance(value, (int, float)):
                wrong.append(f"{file}: {path} is no number: {value}")
    wrong += [f"{file} lacks {key}, which is in the manual" for key in listed
              if key not in met and (name, key) not in optional]
for name, listed in columns.items():
    header = open(name + ".csv", encoding="utf-8").readline().strip().split(",")
    if header != listed:
        wrong.append(f"{name}.csv has {header}, the manual {listed}")
written = {file[:-5].split("+")[0] for file in os.listdir(".") if file.endswith(".json")}
wrong += [f"the manual has no section on {name}" for name in written - keys.keys()]
if len(keys) < 8 or len(columns) < 3:
    wrong.append("the manual's tables were not found")
for line in dict.fromkeys(wrong):
    print("FAILED:", line)
sys.exit(bool(wrong))
END
