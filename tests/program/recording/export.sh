#!/bin/bash
# export.sh FLANEUR [VULKAN]: recordings, trajectories and scenes are written for other programs, are read again, and what
# cannot be is refused in a sentence and leaves no file.
set -euo pipefail
flaneur=$1 vulkan=${2-}
here=$(realpath "$(dirname "$0")")
# shellcheck source-path=SCRIPTDIR source=says.sh
. "$here/says.sh"

runs "flaneur export SOURCE OUT|SOURCE and OUT" export --help
runs "Recorded a.flr" sim --scene corner --walkers 20 --seconds 3 --record a.flr
for file in a.sqlite a.txt a.csv a.fcd.xml a.geojson a.traj; do
    runs "Wrote $file: 4 people, 26 frames" export a.flr $file --walkers 2,5:7 --seconds 1:2
    runs "people +4" inspect $file
done
runs "Wrote b.txt: 1 person, 11 frames" export a.csv b.txt --walkers 6 --fps 10
runs "Wrote c.csv: [0-9]+ people, 51 frames" export --scene corner c.csv --seconds 1:3

refuses "has no ending .*\.glb or \.bvh.*\.traj" export a.flr a.fbx
refuses "no walker 99 in those seconds" export a.flr no.csv --walkers 3,99
refuses "nothing of those seconds: it goes from 0 to 3 s" export a.flr no.csv --seconds 8:9
refuses "Nobody is there" export a.csv no.txt --seconds 50:60
refuses "no file away.flr" export away.flr no.csv
refuses "says not who" export a.flr no.csv --walkers 3-4
refuses "wants what and where to" export a.flr
refuses "is for what is simulated" export a.flr no.csv --seed 3
refuses "OUT is all that is named" export a.flr no.csv --scene corner
refuses "walk all round" export --scene asteroid no.csv
[[ ! -e no.csv && ! -e no.txt && ! -e a.fbx ]] || failed "what was refused leaves a file"

if [[ -z $vulkan ]]; then refuses "without Vulkan" export a.flr no.glb && exit 0; fi
runs "Wrote a.glb: 4 people, 1.0 s" export a.flr a.glb --walkers 2,5:7 --seconds 1:2
runs "people +walker 2, walker 5, walker 6, walker 7" inspect a.glb
runs "animations +everybody, walker 2, " inspect a.glb
runs "Wrote one.glb: 1 person" export a.csv one.glb --walkers 6
runs "animations +walker 6$" inspect one.glb
runs "Wrote in/a/walker_5.bvh, from 0.0 s" export a.flr in/a.bvh --walkers 5:7 --fps 30
[[ $(cd in/a && echo *) == "walker_5.bvh walker_6.bvh walker_7.bvh" && ! -e in/a.bvh ]] || failed "other files"
grep -q "^Frames: 91$" in/a/walker_5.bvh || failed "other frames"
runs "Wrote one.bvh" export a.flr one.bvh --walkers 5
runs "Wrote round.glb: 2 people" export --scene asteroid round.glb --walkers 0:1 --seconds 0:1
