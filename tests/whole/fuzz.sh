#!/bin/bash
# fuzz.sh BUILD NAME SECONDS SHARED [KEPT]: feeds BUILD/NAME_fuzz bytes made by chance for so long. It begins with files of
# BUILD/NAME_seeds and, where they are there, small ones of SHARED. What took it further stays in the folder KEPT, if one is
# given, and is begun with the next time. What crashed it, hung it for a minute or took more than a gigabyte stays in BUILD
# as NAME-crash-*, NAME-timeout-* and NAME-oom-*.
set -euo pipefail
build=$1 name=$2 seconds=$3 shared=$4
case $name in
    gltf) also=(corpus/odd -size -64k '(' -name '*.gl*f' -o -name '*.glb' -o -name '*.vrm' ')') length=65536 ;;
    osm) also=(corpus/osm -size -32k -name '*.osm*') length=16384 ;;
    picture) also=(corpus -size -32k '(' -name '*.png' -o -name '*.jpg' -o -name '*.webp' ')') length=32768 ;;
    path | scene) also=() length=4096 ;;
    recording) also=() length=16384 ;;
    terrain) also=(corpus/osm -size -64k '(' -name '*.tif' -o -name '*.zip' ')') length=32768 ;;
    trajectories) also=(corpus/trajectories -size -32k -type f) length=16384 ;;
    *) echo "fuzz.sh: there is no target $name." >&2 && exit 2 ;;
esac
seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
kept=${5-$seeds/kept}
mkdir -p "$kept" "$seeds/also" "$seeds/tmp"
"$build/${name}_seeds" "$seeds/own"
if [[ ${#also[@]} -gt 0 && -d $shared/${also[0]} ]]; then
    number=0
    while IFS= read -r -d '' file; do
        cp "$file" "$seeds/also/$((++number))"
    done < <(find "$shared/${also[0]}" -type f "${also[@]:1}" -print0 | sort -z)
fi
# Sanitizers take twice the memory and more.
TMPDIR=$seeds/tmp "$build/${name}_fuzz" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=2560 -malloc_limit_mb=700 \
    -max_len="$length" -dict="$(dirname "$0")/../fuzz/words/$name.dict" -artifact_prefix="$build/$name-" -print_final_stats=1 \
    "$kept" "$seeds/also" "$seeds/own"
