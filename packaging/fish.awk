# Writes the completion for fish from the table of options.
function quoted(text) {
    gsub(/\\/, "\\\\", text)
    gsub(/'/, "\\'", text)
    return "'" text "'"
}
BEGIN {
    print "# What Tab offers for flaneur. Written by packaging/pages."
    print "function __flaneur_files"
    print "    set -l endings (string join '|' -- (string escape --style=regex -- $argv))"
    print "    __fish_complete_path (commandline -ct) | string match -r '^[^\\t]*(?:/|'$endings')(?:\\t.*)?$'"
    print "end"
    print "complete -c flaneur -f"
    print "complete -c flaneur -l help -d 'Explain'"
    print "complete -c flaneur -n __fish_use_subcommand -l version -d 'Say the version'"
}
$2 == "" {
    print "complete -c flaneur -n __fish_use_subcommand -a " $1 " -d " quoted($7)
    next
}
{
    line = "complete -c flaneur -n '__fish_seen_subcommand_from " $1 "'"
    if ($2 ~ /^--/) line = line " -l " substr($2, 3)
    if ($3 != "") {
        offers = $8 == "" ? "" : $8 " "
        if ($9 != "") offers = offers "(__flaneur_files " $9 ")"
        else if ($3 ~ /FOLDER/) offers = offers "(__fish_complete_directories)"
        if ($3 ~ /,\.\.\.$/) offers = "(__fish_complete_list , 'string split \" \" \"" $8 "\"')"
        if ($3 ~ /FILE/ && $9 == "") line = line " -r -F"
        else line = line ($2 ~ /^--/ ? " -x" : " -f")
        if (offers != "") line = line " -a " quoted(offers)
    }
    print line " -d " quoted($7)
}
