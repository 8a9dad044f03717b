#!/bin/bash
# fuzz.sh BUILD NAME DICTIONARY SECONDS SHARED: feeds BUILD/NAME_fuzz bytes made by chance for so long. It begins with
# files of BUILD/NAME_seeds and, where they are there, small ones of SHARED. What crashed it, hung it for a minute or took
# more than a gigabyte stays in BUILD as crash-*, timeout-* and oom-*.
set -euo pipefail
build=$1 name=$2 dictionary=$3 seconds=$4 shared=$5
case $name in
    gltf) found=(corpus/odd -size -64k '(' -name '*.gl*f' -o -name '*.glb' -o -name '*.vrm' ')') length=65536 ;;
    osm) found=(corpus/osm -size -32k -name '*.osm*') length=16384 ;;
    scene) found=(scenes -name '*.json') length=4096 ;;
    *) echo "fuzz.sh: there is no target $name." >&2 && exit 2 ;;
esac
seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
"$build/${name}_seeds" "$seeds/own"
mkdir "$seeds/found"
if [[ -d $shared/${found[0]} ]]; then
    number=0
    while IFS= read -r -d '' file; do
        cp "$file" "$seeds/found/$((++number))"
    done < <(find "$shared/${found[0]}" -type f "${found[@]:1}" -print0 | sort -z)
fi
# Sanitizers take twice the memory and more.
"$build/${name}_fuzz" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=2560 -malloc_limit_mb=700 -max_len="$length" \
    -dict="$dictionary" -artifact_prefix="$build/" -print_final_stats=1 "$seeds/found" "$seeds/own"
