# A folder of its own, and what the program says there: for scripts that have `flaneur`, the program.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failed() { echo "FAILED: $*" && cat said && exit 1; }
# runs PATTERN WORDS...: and says something like it.
runs() {
    local pattern=$1
    shift
    "$flaneur" "$@" > said 2>&1 || failed "$*"
    grep -qE -- "$pattern" said || failed "$* does not say $pattern"
}
# refuses PATTERN WORDS...: ends with 1, and says something like it.
refuses() {
    local pattern=$1 status=0
    shift
    "$flaneur" "$@" > said 2>&1 || status=$?
    ((status == 1)) || failed "$* ends with $status"
    grep -qE -- "$pattern" said || failed "$* does not say $pattern"
}
