#!/bin/bash
# format.sh ROOT: every C++ file is as clang-format with ROOT's .clang-format leaves it.
set -euo pipefail
cd "$1"
find sim assets renderer tools python tests -name '*.h' -o -name '*.cpp' | sort |
    xargs clang-format --dry-run -Werror
