#!/bin/bash
# cache.sh FLANEUR: what is kept between runs is where the environment says, for its owner alone, within its bound, and
# gone when it is asked to go; with --no-cache nothing is kept.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export XDG_CACHE_HOME=$folder/kept
unset FLANEUR_CACHE_MAX
expect() { if [[ $1 != $2 ]]; then echo "FAILED: '$1' instead of '$2'" && exit 1; fi; }
people() { "$1" people --count 1 --out out "${@:2}" > /dev/null; }

people "$1" --no-cache
expect "$(ls)" out
people "$1"
expect "$(stat -c %a kept/flaneur)" 700
expect "$(stat -c %a kept/flaneur/person-*)" 600
expect "$("$1" cache)" "$folder/kept/flaneur"$'\n'"1 file, 0.? MiB of at most 1024"
echo mine > kept/flaneur/letter
expect "$("$1" cache --clear)" "Removed 1 file, 0.? MiB from $folder/kept/flaneur"
expect "$(ls kept/flaneur)" letter
FLANEUR_CACHE_MAX=0 people "$1"
expect "$(ls kept/flaneur)" letter
expect "$(FLANEUR_CACHE_MAX=0 "$1" cache)" "Nothing is kept: FLANEUR_CACHE_MAX is 0."
expect "$(env -u XDG_CACHE_HOME -u HOME "$1" cache --clear)" "Nothing is kept: neither*"
# A folder that cannot be made is one that nothing is kept in.
XDG_CACHE_HOME=/dev/null people "$1"
expect "$(XDG_CACHE_HOME=/dev/null "$1" cache)" "*0 files, 0.0 MiB*"
