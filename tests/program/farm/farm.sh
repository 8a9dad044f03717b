#!/bin/bash
# farm.sh FLANEUR FARM parallel|hosts|slurm: a film drawn in eight parts by several workers, one of which is killed on the way,
# is the film of one process, byte for byte. Slurm's daemons, with two machines that are both this one, are our own.
set -euo pipefail
flaneur=$1 farm=$2 by=$3
[[ $by == slurm ]] && needed=(slurmctld slurmd sbatch munged ffmpeg) || needed=(parallel ffmpeg)
for program in "${needed[@]}"; do
    type "$program" > /dev/null 2>&1 || { echo "SKIPPED: $program is not installed" && exit 77; }
done
folder=$(mktemp -d)
clean_up() {
    local pid
    for pid in "$folder"/slurm/*.pid; do [[ ! -f $pid ]] || kill "$(cat "$pid")" 2> /dev/null || true; done
    # They write until they have ended.
    for pid in {1..50}; do
        if rm -rf "$folder" 2> /dev/null; then break; fi
        sleep 0.1
    done
}
trap clean_up EXIT
cd "$folder"
failed() { echo "FAILED: $*" && cat said && exit 1; }

start_slurm() {
    [[ $(id -u) == 0 ]] || { echo "SKIPPED: Slurm's daemons are started by root alone" && exit 77; }
    local here=$folder/slurm name ports
    name=$(hostname -s)
    mkdir -p "$here/state"
    chmod 755 "$folder" "$here"
    head -c 1024 /dev/urandom > "$here/key"
    chmod 400 "$here/key"
    munged --key-file="$here/key" --socket="$here/munge" --pid-file="$here/munge.pid" --log-file="$here/munge.log" \
        --seed-file="$here/seed" --num-threads=2 --force 2> /dev/null
    # Three that nobody listens on.
    read -ra ports < <(python3 -c 'import socket
all = [socket.socket() for _ in range(3)]
for one in all: one.bind(("127.0.0.1", 0))
print(*(one.getsockname()[1] for one in all))')
    cat > "$here/slurm.conf" << END
ClusterName=farm
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$here/munge
StateSaveLocation=$here/state
SlurmdSpoolDir=$here/spool-%n
SlurmctldPidFile=$here/slurmctld.pid
SlurmdPidFile=$here/slurmd-%n.pid
SlurmctldLogFile=$here/slurmctld.log
SlurmdLogFile=$here/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
NodeName=one NodeHostname=$name NodeAddr=127.0.0.1 Port=${ports[1]} CPUs=1
NodeName=two NodeHostname=$name NodeAddr=127.0.0.1 Port=${ports[2]} CPUs=1
PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP
END
    export SLURM_CONF=$here/slurm.conf
    slurmctld -f "$SLURM_CONF"
    for node in one two; do slurmd -N $node -f "$SLURM_CONF"; done
    for _ in {1..100}; do
        [[ $(sinfo -h -t idle -o %D 2> /dev/null) == 2 ]] && return
        sleep 0.2
    done
    tail -n 20 "$here"/*.log > said
    failed "Slurm has not come up"
}

case $by in
    slurm) start_slurm && with=(--slurm) ;;
    hosts)  # a machine that is this one, by another name
        # shellcheck disable=SC2016
        printf '#!/bin/bash\nwhile [[ $1 == -* ]]; do shift; done\nshift\n[[ $1 != -- ]] || shift\nexec bash -c "$*"\n' > ssh
        chmod +x ssh
        export PARALLEL_SSH=$folder/ssh
        with=(--hosts ":,elsewhere" --jobs 1)
        ;;
    *) with=(--jobs 2) ;;
esac

"$flaneur" sim --scene life --walkers 40 --seconds 20 --record run.flr > said 2>&1 || failed "nothing is recorded"
film=("$flaneur" render --replay run.flr --size 320x180 --camera "61.06,4.12,37.25/48.76,0.82,41.45" --fov 45 --frames 0:1200:4)
"${film[@]}" --out alone.mp4 > said 2>&1 || failed "nothing is drawn"

# Kills one that draws.
kill_one() {
    local process
    while sleep 0.05; do
        [[ -n $(find out.mp4.parts -name '*.png' 2> /dev/null | head -n 1) ]] || continue
        for process in /proc/[0-9]*; do
            [[ $(readlink "$process/exe" || true) == "$flaneur" && $(readlink "$process/cwd" || true) == "$folder" ]] || continue
            kill -9 "${process#/proc/}" 2> /dev/null && touch killed && return
        done
    done
}
flaneur=$(realpath "$flaneur")
kill_one 2> /dev/null &
killer=$!
began=$(date +%s)
"$farm" film --parts 8 "${with[@]}" -- "${film[@]}" --out out.mp4 > said 2>&1 || failed "the farm ends with $?"
kill $killer 2> /dev/null || true
echo "drawn in $(($(date +%s) - began)) s"
[[ -f killed ]] || failed "nobody was killed"
grep -qE "1 of 8 are run again" said || failed "nothing was run again, or more than what was lost"
grep -qE "8 parts: .* times as fast" said || failed "it does not say how fast it was"
cat said
cmp alone.mp4 out.mp4 || failed "another film"

# What is done is not done again; what has gone is found.
rm out.mp4
touch -d 2001-01-01 out.mp4.parts/*.png
"$farm" film --parts 8 "${with[@]}" -- "${film[@]}" --out out.mp4 > said 2>&1 || failed "the second time it ends with $?"
cmp alone.mp4 out.mp4 || failed "another film, the second time"
rm out.mp4.parts/00000400.png
truncate -s -5 out.mp4.parts/00000800.png
if "$farm" film --parts 8 "${with[@]}" -- "${film[@]}" --out out.mp4 > said 2>&1; then failed "joined without a picture"; fi
grep -q "lacks 2 of its 301 pictures, the first that of tick 400" said || failed "it does not say what is missing"
"$farm" film --parts 8 "${with[@]}" -- "${film[@]}" --out out.mp4 > said 2>&1 || failed "the third time it ends with $?"
cmp alone.mp4 out.mp4 || failed "another film, the third time"
[[ $(find out.mp4.parts -name '*.png' -newermt 2002-01-01 | wc -l) == 2 ]] || failed "drew again what was there"
if "$farm" film --parts 3 "${with[@]}" -- "${film[@]}" --fov 30 --out out.mp4 > said 2>&1; then failed "mixed two films"; fi
grep -q "was begun with --fov 45, not --fov" said || failed "it does not say that it is another film"
