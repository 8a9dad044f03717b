#!/bin/bash
# fuzz.sh BUILD DICTIONARY SECONDS SHARED: feeds the glTF reader bytes made by chance for so long. It begins with files
# of its own and, where they are there, the small odd ones of SHARED. What crashed it, hung it for a minute or took
# more than a gigabyte stays in BUILD as crash-*, timeout-* and oom-*.
set -euo pipefail
build=$1 dictionary=$2 seconds=$3 shared=$4
seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
"$build/gltf_seeds" "$seeds/own"
mkdir "$seeds/found"
if [[ -d $shared/corpus/odd ]]; then
    number=0
    while IFS= read -r -d '' file; do
        cp "$file" "$seeds/found/$((++number))"
    done < <(find "$shared/corpus/odd" -type f -size -64k \( -name '*.gl*f' -o -name '*.glb' -o -name '*.vrm' \) -print0 | sort -z)
fi
# Sanitizers take twice the memory and more.
"$build/gltf_fuzz" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=2560 -malloc_limit_mb=700 -max_len=65536 \
    -dict="$dictionary" -artifact_prefix="$build/" -print_final_stats=1 "$seeds/found" "$seeds/own"
