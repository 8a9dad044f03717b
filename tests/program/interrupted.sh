#!/bin/bash
# interrupted.sh FLANEUR MAP: whatever the program is at, SIGINT, SIGQUIT, SIGTERM and SIGHUP end it within two seconds by that
# signal, and nothing half-written is left. MAP is a large one; without it that part is left out.
set -euo pipefail
ulimit -c 0
flaneur=$1 map=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/here"
cd "$folder/here"
failed() { echo "FAILED: $*" && cat ../said && exit 1; }

# Waits until the process is the program: before, it is the shell, which treats signals as it likes.
begun() {
    while [[ -d /proc/$1 && $(cat "/proc/$1/comm" 2> /dev/null) != "$(basename "$flaneur")" ]]; do sleep 0.01; done
}

# interrupt SIGNAL SECONDS WORDS...: `flaneur WORDS` after so many seconds. $ended says "interrupted", or "done" where it
# was quicker. A machine may be busy once; who is slow is slow three times.
interrupt() {
    local took
    for again in 1 2 3; do
        interrupt_once "$@"
        if ((took < 2000)); then return; fi
        if ((again < 3)); then rm -rf ./*; fi
    done
    failed "it took $took ms"
}

interrupt_once() {
    local signal=$1 after=$2 pid status=0 start
    shift 2
    env --default-signal=INT,QUIT,TERM,HUP "$flaneur" "$@" > ../printed 2> ../said &
    pid=$!
    begun $pid
    sleep "$after"
    start=${EPOCHREALTIME/./}
    kill "-$signal" $pid 2> /dev/null || true
    wait $pid || status=$?
    took=$(((${EPOCHREALTIME/./} - start) / 1000))
    echo "$signal after $after s: status $status after $took ms: flaneur $*"
    if ((status == 0)); then ended="done" took=0 && return; fi
    ended=interrupted
    ((status == 128 + $(kill -l "$signal"))) || failed "status $status"
    # So soon, it may not have come to hear signals yet.
    [[ $after == 0.[01]* && ! -s ../said ]] || grep --quiet '^flaneur: Interrupted' ../said || failed "nothing was said"
    if [[ -n $(find . -name '*.part') ]]; then find . && failed "something half-written is left"; fi
}

# nothing_left WORDS...: it leaves nothing, not even a folder. Signals take turns; who is done before is asked earlier.
turn=0
nothing_left() {
    local signals=(INT TERM HUP QUIT) moments=(1 0.5 2 0.7) moment
    for moment in "${moments[turn % 4]}" 0.1 0.02; do
        interrupt "${signals[turn % 4]}" "$moment" "$@"
        if [[ $ended == interrupted ]]; then break; fi
        rm -rf ./*
    done
    turn=$((turn + 1))
    [[ $ended == interrupted ]] || failed "it was always quicker"
    if [[ -n $(ls -A) ]]; then find . && failed "left behind"; fi
}

scene=(--scene corner --walkers 20)
# With nothing kept: people are made, the mesh is built.
XDG_CACHE_HOME=$folder/none
export XDG_CACHE_HOME
echo '{ "blocks": 20 }' > ../large.json
nothing_left city --scene ../large.json --out deep/city.glb
nothing_left people --count 1000 --out deep/people
nothing_left sim --walkers 3000 --seconds 100000 --hash-log log.txt
# With all of it kept, they are soon at what they do.
XDG_CACHE_HOME=$folder/kept
"$flaneur" sim "${scene[@]}" --seconds 0
nothing_left sim "${scene[@]}" --seconds 100000 --hash-log log.txt
nothing_left sim "${scene[@]}" --seconds 100000 --trajectories deep/a.sqlite
nothing_left sim "${scene[@]}" --seconds 100000 --trajectories a.txt --fps 60
nothing_left validate R9 R15 --json deep/a.json --markdown a.md
nothing_left gait --crowd 20 --seconds 600 --csv a.csv --json a.json
nothing_left gait --everyone --csv a.csv --json a.json
nothing_left bench crowd "${scene[@]}" --frames 1000000 --json a.json
nothing_left bench pose "${scene[@]}" --frames 100000 --json a.json
nothing_left bench city "${scene[@]}" --frames 100000 --json a.json
if "$flaneur" render --help > /dev/null 2>&1 && "$flaneur" render "${scene[@]}" --frames 0 --size 16x16 --out a.png; then
    rm a.png
    nothing_left bench frame "${scene[@]}" --frames 1000000 --size 320x180 --json a.json
    nothing_left city "${scene[@]}" --seconds 100000 --check --json a.json
    nothing_left render "${scene[@]}" --frames 10000000 --size 320x180 --out deep/a.png
    nothing_left people --count 500 --sheet sheet.png
    interrupt INT 1 gait --speed 1 --strip strip.png --json a.json
    rm -f strip.png a.json  # either may be whole
    # Pictures that are whole stay.
    for moment in 2 4 8 16 32; do
        interrupt INT "$moment" render "${scene[@]}" --frames 0:100000 --size 64x48 --out many/%06d.png
        [[ $ended == interrupted ]] || failed "a hundred thousand pictures in $moment s"
        count=$(find . -name '*.png' | wc -l)
        if ((count > 0)); then break; fi
    done
    grep --quiet "has the first $count of 100001 pictures" ../said || failed "$count pictures"
    for picture in many/*; do ffprobe -v error "$picture" || failed "$picture is not whole"; done
    rm -r many
    # A film is finished with what it has.
    for moment in 2 4 8 16 32; do
        interrupt TERM "$moment" render "${scene[@]}" --frames 0:100000 --size 64x48 --out a.mp4
        if [[ -f a.mp4 ]]; then break; fi
    done
    count=$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 a.mp4)
    grep --quiet "has the first $count of 100001 pictures" ../said || failed "a film of $count pictures"
    [[ $(ls -A) == a.mp4 ]] || failed "more than a film is left"
    rm a.mp4
fi

# What grows beyond a limit is told as on a full disk.
status=0
(ulimit -f 100 && exec "$flaneur" sim "${scene[@]}" --seconds 60 --trajectories a.csv) 2> ../said || status=$?
((status == 1)) && grep --quiet 'Cannot write a.csv: File too large' ../said || failed "a file that is too large: status $status"
[[ -z $(ls -A) ]] || failed "left behind"

# What a parent has it ignore stays ignored.
env --ignore-signal=HUP "$flaneur" sim "${scene[@]}" --seconds 2000 2> ../said &
pid=$!
begun $pid
sleep 0.3
kill -HUP $pid
wait $pid || failed "a signal that is ignored was obeyed"

if [[ -f $map ]]; then
    XDG_CACHE_HOME=$folder/none
    rm -rf "$folder/none"
    for moment in "INT 0.3" "TERM 3" "HUP 8"; do
        # shellcheck disable=SC2086
        interrupt $moment sim --city "$map" --seconds 100000 --hash-log log.txt
        [[ -z $(ls -A) ]] || failed "left behind"
    done
    nothing_left inspect "$map" --json a.json
else
    echo "LEFT OUT: there is no $map to interrupt the loading of."
fi
