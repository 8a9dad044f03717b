#!/bin/bash
# install.sh ROOT BUILD: what `cmake --install` puts into a prefix serves from wherever that is moved to, and hands those
# who link it nothing but its headers.
set -euo pipefail
export LC_ALL=C.UTF-8
root=$(realpath "$1") build=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" && exit 1; }

cmake --install "$build" --prefix "$folder/first" > "$folder/log" || { cat "$folder/log" && exit 1; }
prefix=$folder/moved
mv "$folder/first" "$prefix"
found=$(grep -rlIE "$root|$build|$folder" "$prefix" || true)
[[ -z $found ]] || fail "these name a folder of where they were built: $found"
found=$(find "$prefix/include" -mindepth 1 -maxdepth 1 ! -name flaneur)
[[ -z $found ]] || fail "beside include/flaneur there is $found"
found=$(find "$prefix/include" -name '*-inl.h')
[[ -z $found ]] || fail "internals are installed: $found"
"$prefix/bin/flaneur" --version

# Each header stands by itself, with every warning that is ours; all together do with the other compiler and the standard
# to come. shaders/shared.h is GLSL, too, and stands within renderer/shared.h.
cd "$prefix/include"
if grep -rnE '^#include "' flaneur; then fail "a header names another by a path of our own"; fi
check() {
    "$@" -x c++ -fsyntax-only -I. -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror -
}
export -f check
find flaneur -name '*.h' ! -path flaneur/shaders/shared.h -printf '#include <%p>\n' > "$folder/headers"
tr '\n' '\0' < "$folder/headers" | xargs -0 -P 2 -I {} bash -c 'check g++ -std=c++20 <<< "$0" || exit 255' {} ||
    fail "a header warns or does not stand by itself"
check clang++ -std=c++2b < "$folder/headers" || fail "headers warn with Clang"

# What find_package says and hands on.
mkdir "$folder/user"
cat > "$folder/user/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.16)
project(user LANGUAGES CXX)
find_package(flaneur ${WANTED} REQUIRED COMPONENTS ${COMPONENTS})
foreach(component IN LISTS COMPONENTS)
    foreach(what COMPILE_OPTIONS COMPILE_DEFINITIONS LINK_OPTIONS INCLUDE_DIRECTORIES COMPILE_FEATURES)
        get_target_property(value flaneur::${component} INTERFACE_${what})
        message(STATUS "${component} ${what} ${value}")
    endforeach()
endforeach()
END
user() {
    rm -rf "$folder/user/build"
    cmake -S "$folder/user" -B "$folder/user/build" -DCMAKE_PREFIX_PATH="$prefix" -DWANTED="$1" "-DCOMPONENTS=$2" \
        > "$folder/log" 2>&1
}
components=$(sed -n 's/^set(flaneur_installed \(.*\))$/\1/p' "$prefix/lib/cmake/flaneur/flaneur-config.cmake")
user 0.1 "$components" || { cat "$folder/log" && exit 1; }
while read -r _ component what value; do
    case $what in
        INCLUDE_DIRECTORIES) [[ $value == "$prefix/include" ]] ;;
        COMPILE_FEATURES) [[ $value == cxx_std_20 ]] ;;
        *) [[ $value == *-NOTFOUND ]] ;;
    esac || fail "those who link flaneur::$component inherit $what $value"
done < <(grep -E '^-- [a-z]+ (COMPILE|LINK|INCLUDE)' "$folder/log")
refuses() {
    if user "$1" "$2"; then fail "flaneur $1 with $2 is found"; fi
    tr -s ' \n' ' ' < "$folder/log" | grep -qF -- "$3" || { cat "$folder/log" && fail "it does not say: $3"; }
}
refuses 0.2 sim "0.1"
refuses 0.1 "sim;weather" "There is no flaneur::weather in this flaneur, which was installed with: sim, assets"
sed -i 's/"detour Detour /"detour NoSuchLibrary /' "$prefix/lib/cmake/flaneur/flaneur-dependencies.cmake"
refuses 0.1 sim "On Debian: apt install librecast-dev"

# As a folder of a larger project, whose targets may be named like our folders, it brings its libraries and no more.
mkdir "$folder/larger"
draws=$([[ $components == *renderer* ]] && echo ON || echo OFF)
header=$([[ $draws == ON ]] && echo extract/extract.h || echo assets/scene.h)
cat > "$folder/larger/CMakeLists.txt" << END
cmake_minimum_required(VERSION 3.25)
project(larger LANGUAGES CXX)
add_library(sim INTERFACE)
add_library(assets INTERFACE)
add_library(renderer INTERFACE)
add_subdirectory($root flaneur)
file(WRITE \${CMAKE_BINARY_DIR}/main.cpp "#include <flaneur/$header>\nint main() {}\n")
add_executable(larger \${CMAKE_BINARY_DIR}/main.cpp)
target_include_directories(larger PRIVATE \$<TARGET_PROPERTY:flaneur::assets,INTERFACE_INCLUDE_DIRECTORIES>)
add_dependencies(larger flaneur_headers)
target_compile_features(larger PRIVATE cxx_std_20)
target_compile_options(larger PRIVATE -Wall -Wextra -Werror)
if(CMAKE_BUILD_TYPE OR CMAKE_CXX_STANDARD OR CMAKE_RUNTIME_OUTPUT_DIRECTORY OR TARGET flaneur OR TARGET sim_tests)
    message(FATAL_ERROR "flaneur changes the project around it")
endif()
END
cmake -S "$folder/larger" -B "$folder/larger/build" -DFLANEUR_VULKAN=$draws \
    > "$folder/log" 2>&1 && cmake --build "$folder/larger/build" --target larger >> "$folder/log" 2>&1 ||
    { cat "$folder/log" && fail "it does not build within another project"; }
if grep -q -- '-W' "$folder/larger/build/flaneur/sim/CMakeFiles/flaneur_sim.dir/flags.make"; then
    fail "a project around ours gets our warnings"
fi
