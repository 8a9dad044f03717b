# What Tab offers for flaneur in bash.
_flaneur_options() {
    # command|option or word|value|words|endings
    cat << 'END'
@OPTIONS@
END
}

# Those of the words that go on from what is typed.
_flaneur_words() { mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$1" -- "$2"); }

# Files with one of the endings, or any file where there are none, and folders to look in.
_flaneur_files() {
    local ending
    compopt -o filenames 2> /dev/null
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(
        if [[ $1 == '' ]]; then compgen -f -- "$2" && exit; fi
        compgen -d -- "$2"
        for ending in $1; do compgen -f -X "!*$ending" -- "$2"; done)
}

_flaneur() {
    local typed=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    if [[ $typed == = ]]; then typed=; elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD - 2]}; fi
    local command name value words endings
    local commands='' options='' placed=() place
    COMPREPLY=()
    while IFS='|' read -r command name value words endings; do
        if [[ $name == '' ]]; then
            commands+=" $command"
        elif ((COMP_CWORD > 1)) && [[ $command == "${COMP_WORDS[1]}" ]]; then
            if [[ $name == -* ]]; then options+=" $name"; else placed+=("$value|$words|$endings"); fi
            if [[ $name == "$before" && $value != '' ]]; then
                if [[ $value == *,... && $typed == *,* ]]; then
                    words=" $words"
                    words=${words// / "${typed%,*}",}
                fi
                _flaneur_words "$words" "$typed"
                if [[ $value == *FILE* ]]; then _flaneur_files "$endings" "$typed"; fi
                if [[ $value == *FOLDER* ]]; then mapfile -t COMPREPLY < <(compgen -d -- "$typed"); fi
                return
            fi
        fi
    done < <(_flaneur_options)
    if ((COMP_CWORD == 1)); then
        _flaneur_words "$commands --help --version" "$typed"
    elif ((${#placed[@]} > 0)) && [[ $typed != -* ]]; then
        place=$((COMP_CWORD - 2 < ${#placed[@]} ? COMP_CWORD - 2 : ${#placed[@]} - 1))
        IFS='|' read -r value words endings <<< "${placed[place]}"
        _flaneur_words "$words" "$typed"
        if [[ $value == *FILE* ]]; then _flaneur_files "$endings" "$typed"; fi
    else
        _flaneur_words "$options --help" "$typed"
    fi
}
complete -F _flaneur flaneur
