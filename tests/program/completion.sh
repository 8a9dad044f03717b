#!/bin/bash
# completion.sh BASH_SCRIPT ZSH_FOLDER FISH_SCRIPT: what Tab offers in each shell.
set -euo pipefail
export LC_ALL=C.UTF-8
bash_script=$1 zsh_folder=$2 fish_script=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir sub
touch berlin.osm monaco.osm.pbf me.glb notes.txt my.json

in_bash() {
    bash --norc -c 'source "$1" && shift && COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) && _flaneur && echo "${COMPREPLY[*]}"' \
        bash "$bash_script" flaneur "$@"
}
in_fish() {
    local line
    printf -v line '%s ' flaneur "$@"
    HOME=$folder fish --no-config -c "source $fish_script; complete -C '${line% }'" | cut -f 1
}
# zsh completes only where there is a terminal: zpty makes one, and Tab writes what is sure or lists what is not. It says
# when it edits a line, as what is typed before is not for it.
in_zsh() {
    local line
    printf -v line '%s ' flaneur "$@"
    HOME=$folder zsh -f -c '
        zmodload zsh/zpty
        zpty shell zsh -f -i
        zpty -w shell "PS1=; fpath=($1 \$fpath); autoload -Uz compinit; compinit -D -u; stty rows 60 cols 250; zle-line-init() { print -rn EDI\TS }; zle -N zle-line-init"
        zpty -r shell seen "*EDITS*"
        zpty -w -n shell "$2"$'"'\t\t'"'
        zpty -w -n shell $'"'\x05\x15'"'"print -r DO\NE"$'"'\n'"'
        zpty -r shell seen "*DONE*"
        print -r -- $seen' zsh "$zsh_folder" "${line% }" | sed 's/\x1b\[[0-9;?]*[a-zA-Z]//g' | tr -d '\r\a'
}
# expect WORD... -- OFFERED... [-- LEFT OUT...]: completing the last word offers the ones, and not the others.
expect() {
    local words=() offered=() left_out=() into=words shell said one
    for one; do
        if [[ $one == -- ]]; then
            if [[ $into == words ]]; then into=offered; else into=left_out; fi
        else
            case $into in words) words+=("$one") ;; offered) offered+=("$one") ;; *) left_out+=("$one") ;; esac
        fi
    done
    for shell in bash zsh fish; do
        said=$(in_$shell "${words[@]}")
        for one in "${offered[@]}"; do
            grep -qF -- "$one" <<< "$said" || { echo "FAILED: $shell, ${words[*]}: no $one in: $said" && exit 1; }
        done
        for one in "${left_out[@]}"; do
            ! grep -qF -- "$one" <<< "$said" || { echo "FAILED: $shell, ${words[*]}: $one in: $said" && exit 1; }
        done
    done
}
expect '' -- view render sim check bench gait people inspect city
expect ren -- render -- people
expect render --qual -- --quality
expect render --quality '' -- low medium high ultra
expect render --scene '' -- asteroid district my.json sub -- notes.txt
expect render --city '' -- berlin.osm monaco.osm.pbf me.glb sub -- notes.txt my.json
expect render --character '' -- builtin me.glb -- notes.txt berlin.osm
expect view --view skeletons,tr -- skeletons,trails
expect gait --view s -- side
expect gait --st -- --stairs -- --scene
expect sim --hash-log '' -- notes.txt sub
expect check --against '' -- notes.txt sub
expect people --out '' -- sub -- notes.txt
expect bench cr -- crowd
expect inspect '' -- me.glb berlin.osm -- notes.txt
