#!/bin/bash
# examples.sh ROOT BUILD COMPILER: the examples, copied away from our sources, build against an installed flaneur without
# a warning and do what they say.
set -euo pipefail
export LC_ALL=C.UTF-8
root=$(realpath "$1") build=$(realpath "$2") compiler=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" && exit 1; }

cmake --install "$build" --prefix "$folder/prefix" --component dev > /dev/null
cp -r "$root/examples" "$folder/examples"
cd "$folder"
# build_example NAME FLAGS [SUFFIX]: warnings of our headers count, too.
build_example() {
    cmake -S "examples/$1" -B "build/$1${3-}" -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
        -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror $2" -DCMAKE_NO_SYSTEM_FROM_IMPORTED=ON > log 2>&1 &&
        cmake --build "build/$1${3-}" >> log 2>&1 || { cat log && fail "$1 does not build with $compiler $2"; }
    if ninja -C "build/$1${3-}" -t deps | grep -qF "$root/"; then fail "$1 is built with our sources in sight"; fi
}

build_example walkers -O2
build/walkers/walkers > walkers.txt
[[ $(grep -cE '^[0-9]+ is at -?[0-9.]+ -?[0-9.]+$' walkers.txt) == 1000 ]] || fail "walkers prints: $(head -3 walkers.txt)"
[[ $(grep is.at walkers.txt | cut -d ' ' -f 4- | sort -u | wc -l) -gt 990 ]] || fail "walkers stand in one place"
# A user whose compiler may fuse a product and a sum gets the same run, to the last bit.
if [[ $(uname -m) == x86_64 ]] && grep -qw fma /proc/cpuinfo; then
    build_example walkers "-O1 -march=haswell -ffp-contract=fast -fno-inline" _fused
    build/walkers_fused/walkers | diff walkers.txt - || fail "a user's flags change the simulation"
fi

build_example skeleton -O2
build/skeleton/skeleton | tee skeleton.txt
awk '/^(thigh|shin|foot)/ { legs++; if ($8 > 1) far = 1 } END { exit legs != 6 || far }' skeleton.txt ||
    fail "the legs of the other skeleton are not where flaneur's are"
if grep -qE '^(arm|thigh|shin).* 0.000 0.000 0.000 1.000' skeleton.txt; then fail "a bone keeps its rest"; fi

if [[ -e prefix/include/flaneur/renderer ]]; then
    build_example picture -O2
    build/picture/picture
    head -1 picture.ppm
    [[ $(head -1 picture.ppm) == "P6 960 540 255" && $(wc -c < picture.ppm) == $((15 + 3 * 960 * 540)) ]] ||
        fail "picture.ppm is no picture of 960x540"
    colours=$(tail -c +16 picture.ppm | xxd -p -c 3 | sort -u | wc -l)
    ((colours > 5000)) || fail "the picture has $colours colours"
    mkdir -p "$build/examples"
    cp picture.ppm "$build/examples/picture_$(basename "$compiler").ppm"  # to look at
fi
