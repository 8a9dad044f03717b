#!/bin/bash
# run.sh PYTHON FOLDER FLANEUR [WORDS...]: the tests of `import flaneur`, by pytest, of the package that lies in FOLDER; skipped
# where it was not built, or something is missing to test it.
set -euo pipefail
python=$1 package=$(realpath -m "$2") program=$(realpath -m "$3")
shift 3
skip() { echo "SKIPPED: $*" && exit 77; }
[[ -e $package/flaneur ]] || skip "the Python module was not built: tools/packages test installs what it takes."
"$python" -c 'import pytest' 2> /dev/null || skip "there is no pytest for $python: tools/packages test installs it."
export PYTHONPATH=$package FLANEUR=$program PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=agg
cd "$(dirname "$0")"
"$python" -m pytest -q -p no:cacheprovider -rs "$@"
