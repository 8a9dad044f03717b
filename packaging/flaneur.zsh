#compdef flaneur
# What Tab offers for flaneur in zsh.
setopt local_options extended_glob no_ksh_arrays
local -a rows commands specs fields
local row state line MATCH place=1
rows=(${(f)"$(cat << 'END'
@OPTIONS@
END
)"})
# command|option or word|value|words|endings|description
for row in $rows; do
    fields=("${(@s:|:)row}")
    local what=${fields[6]//(#m)[\[\]:]/\\$MATCH} value=${fields[3]//:/\\:} action=
    if [[ $fields[2] == '' ]]; then
        commands+=("$fields[1]:$what")
    elif [[ $fields[1] == $words[2] ]]; then
        if [[ $fields[3] == *,... ]]; then action="_values -s , view $fields[4]"
        elif [[ $fields[5] != '' ]]; then
            # With a bar in it, even of one ending, it is a pattern and no glob qualifier.
            action="_files -g '*(${fields[5]// /|}|${fields[5]%% *})'"
        elif [[ $fields[3] == *FILE* ]]; then action=_files
        elif [[ $fields[3] == *FOLDER* ]]; then action='_files -/'
        elif [[ $fields[4] != '' ]]; then action="($fields[4])"
        fi
        if [[ $fields[4] != '' && $fields[5] != '' ]]; then
            action="{compadd -- $fields[4]; $action}"
        fi
        if [[ $fields[2] != -* ]]; then specs+=("$place:$value:$action") place='*'
        elif [[ $fields[3] == '' ]]; then specs+=("$fields[2][$what]")
        else specs+=("*$fields[2]=[$what]:$value:$action")
        fi
    fi
done
_arguments -C '--help[explain]' '(- *)--version[say the version]' '1:command:->command' '*::word:->words'
case $state in
    command) _describe command commands ;;
    words) _arguments '--help[explain]' $specs ;;
esac
