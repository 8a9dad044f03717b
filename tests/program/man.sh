#!/bin/bash
# man.sh FLANEUR PAGE: the manual page reads without a complaint, and tells of every command and option that
# `flaneur --help` tells of, in the part of its command.
set -euo pipefail
export LC_ALL=C.UTF-8
flaneur=$1 page=$2
complaints=$(man --warnings --encoding=UTF-8 --local-file "$page" 2>&1 > /dev/null)
[[ -z $complaints ]] || { echo "FAILED: $complaints" && exit 1; }
text=$(MANWIDTH=200 man --encoding=UTF-8 --local-file "$page" | col -bx)
if grep -E 'Default: [^ ]+\.  +[A-Z]' <<< "$text"; then echo "FAILED: the last option runs into what comes after it." && exit 1; fi
options=0
for command in $("$flaneur" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    part=$(awk -v title="   flaneur $command" '$0 == title { on = 1; next } /^(   )?[^ ]/ { on = 0 } on' <<< "$text")
    [[ -n $part ]] || { echo "FAILED: no part on flaneur $command" && exit 1; }
    while read -r option; do
        grep -qE -- "^ +$option( |\$)" <<< "$part" ||
            { echo "FAILED: the part on flaneur $command lacks $option" && exit 1; }
        options=$((options + 1))
    done < <("$flaneur" "$command" --help | grep -oE '^ +--[a-z-]+' | tr -d ' ')
done
echo "$options options"
((options > 50)) || { echo "FAILED: --help tells of $options options alone." && exit 1; }
