#!/bin/bash
# refused.sh PATTERN COMMAND...: the command must fail by itself with one sentence on stderr that begins with
# "flaneur: " and matches PATTERN, print nothing else, and leave nothing in the folder it runs in.
set -euo pipefail
pattern=$1
shift

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/here"
cd "$folder/here"
status=0
"$@" > ../stdout 2> ../stderr || status=$?
echo "exit status $status, on stderr:"
cat ../stderr
if ((status == 0 || status >= 126)); then echo "FAILED: it should refuse, not succeed or crash." && exit 1; fi
if [[ -s ../stdout ]]; then echo "FAILED: something on stdout:" && cat ../stdout && exit 1; fi
if (($(grep --count '^flaneur: ' ../stderr) != 1)); then echo "FAILED: not one sentence." && exit 1; fi
if grep --quiet --perl-regexp '[\x00-\x08\x0b-\x1f\x7f]' ../stderr; then echo "FAILED: it steers the terminal." && exit 1; fi
if ! grep --quiet --extended-regexp "^flaneur: .*($pattern)" ../stderr; then echo "FAILED: no match for: $pattern" && exit 1; fi
if [[ -n $(ls -A) ]]; then echo "FAILED: left behind:" && find . && exit 1; fi
