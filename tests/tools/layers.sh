#!/bin/bash
# layers.sh ROOT: who includes whom. The arrows of docs/ARCHITECTURE.md.
set -euo pipefail
cd "$1"
bad=0
# only FOLDER ALLOWED...: project files in FOLDER include no project file outside the allowed folders.
only() {
    local folder=$1 allowed
    shift
    allowed=$(IFS='|' && echo "$*")
    if grep -rnE '#include "(sim|assets|renderer|shaders|tools|tests)/' "$folder" --include='*.h' --include='*.cpp' |
        grep -vE "#include \"($allowed)/"; then
        echo "FAILED: $folder may include $* only."
        bad=1
    fi
}
only sim sim
only sim/base sim/base
only sim/city sim/base sim/city
only sim/ik sim/base sim/ik
only sim/surface sim/base sim/surface
only assets assets sim
only renderer renderer shaders sim/base
only shaders shaders
only tests/sim sim tests/sim
exit $bad
