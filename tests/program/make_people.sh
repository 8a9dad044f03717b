#!/bin/bash
# make_people.sh FLANEUR FOLDER: the built-in people, made anew, as a cache in FOLDER.
set -euo pipefail
rm -rf "$2"
mkdir -p "$2"
XDG_CACHE_HOME=$2 "$1" sim --scene corner --seconds 0
rm -f "$2"/flaneur/navmesh-*
[[ -n $(ls -A "$2/flaneur") ]]
