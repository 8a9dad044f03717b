# Writes flaneur.1 from the table of options; `footers` is the folder of what --help ends with, `frame` the file with the
# sections that stand after the commands.
function roff(text) {
    gsub(/\\/, "\\e", text)
    gsub(/-/, "\\-", text)
    gsub(/'/, "\\(aq", text)
    if (text ~ /^\./) text = "\\&" text
    return text
}
# What --help ends with: prose, and after "Examples:" lines as they stand.
function footer(command,    line, verbatim, begun) {
    while ((getline line < (footers "/" command)) > 0) {
        if (!begun++) print ".PP"
        if (line == "Examples:") {
            print ".PP\nExamples:\n.PP\n.nf\n.RS"
            verbatim = 1
        } else if (verbatim && line !~ /^ /) {
            print ".RE\n.fi\n.PP\n" roff(line)
            verbatim = 0
        } else {
            sub(/^  /, "", line)
            print roff(line)
        }
    }
    if (verbatim) print ".RE\n.fi"
}
BEGIN {
    print ".TH FLANEUR 1 \"\" \"flaneur " version "\" \"User Commands\""
    print ".SH NAME\nflaneur \\- fill a city with people, and watch, check and profile them"
    print ".SH SYNOPSIS\n.B flaneur\n.I command\n.RI [ options ]"
    print ".br\n.B flaneur\n.RI [ command ]\n.B \\-\\-help\n.br\n.B flaneur \\-\\-version"
    print ".SH DESCRIPTION"
    print ".B flaneur\nlets hundreds to a hundred thousand people walk about a generated district or a real place from OpenStreetMap,"
    print "feet planted, and draws them with Vulkan on a GPU or on none."
    print "The same city, people and seed give the same run to the last bit on every machine."
    print ".PP"
    footer("flaneur")
    print ".SH COMMANDS"
}
$2 == "" {
    if (command != "") footer(command)
    command = $1
    group = ""
    print ".SS flaneur " command "\n" roff($7) "."
    print ".PP"
    next
}
{
    if ($6 != group) print ".PP\n" roff($6) ":"
    group = $6
    printf ".TP\n.B %s\n", roff($2) ($3 == "" ? "" : " \\fI" roff($3) "\\fR")
    printf "%s.", roff($7)
    print $4 == "" ? "" : " Default: " roff($4) "."
}
END {
    if (command != "") footer(command)
    while ((getline line < frame) > 0) print line
}
