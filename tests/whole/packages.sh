#!/bin/bash
# packages.sh ROOT BUILD: what `cpack` makes: Debian packages whose files serve from where they are unpacked, and
# which depend on what these are linked with.
set -euo pipefail
export LC_ALL=C.UTF-8
root=$(realpath "$1") build=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" && exit 1; }

(cd "$build" && cpack -B "$folder/packages") > "$folder/log" 2>&1 || { cat "$folder/log" && exit 1; }
cd "$folder/packages"
program=$(ls flaneur_*.deb) dev=$(ls libflaneur-dev_*.deb) check=$(ls rendercheck_*.deb)
python=$(ls python3-flaneur_*.deb 2> /dev/null || true)  # where Python is there to build it
for package in "$program" "$dev" "$check" $python; do
    dpkg-deb --fsys-tarfile "$package" | tar -tv > "$folder/files"
    awk '$2 != "root/root" || $1 ~ /^-.*w.*w/ || $1 ~ /^d/ && $1 != "drwxr-xr-x" { print; bad = 1 } END { exit bad }' \
        "$folder/files" || fail "$package: owners or permissions"
    awk '$NF !~ /^\.\/$|^\.\/usr\// { print; bad = 1 } END { exit bad }' "$folder/files" || fail "$package: outside of /usr"
    dpkg-deb --extract "$package" "$folder/root"
    dpkg-deb --info "$package" | grep -E '^ (Package|Depends|Recommends)'
done

depends() { dpkg-deb --field "$1" Depends | tr ',' '\n' | sed -E 's/^ *//; s/ .*//' | sort; }
for package in "$program" "$dev" "$check" $python; do
    for name in $(depends "$package"); do
        dpkg-query --show "$name" > /dev/null || fail "$package depends on $name, which is no package here"
    done
done
# The programs: the packages of all libraries that they are linked with, directly or by those, are needed or are there anyway.
check_links() {  # FILE PACKAGE
    local library path owner
    for library in $(objdump -p "$folder"/root/usr/$1 | awk '$1 == "NEEDED" { print $2 }'); do
        path=$(ldconfig -p | awk -v name="$library" '$1 == name && !n++ { print $NF }')
        owner=$({ dpkg-query --search "$path" "$(realpath "$path")" 2> /dev/null || true; } | sed -n '1s/:.*//p')
        depends "$2" | grep -x "$owner" > /dev/null || fail "$1 is linked with $library, and does not depend on $owner"
    done
}
check_links bin/flaneur "$program"
check_links bin/rendercheck "$check"
if [[ -n $python ]]; then check_links "lib/python3/dist-packages/flaneur/_native.*.so" "$python"; fi
depends "$program" | grep -x libvulkan1 > /dev/null || fail "flaneur draws, and does not depend on libvulkan1"
depends "$program" | grep -x mesa-vulkan-drivers > /dev/null || fail "flaneur draws, and depends on no driver"
[[ $(dpkg-deb --field "$program" Recommends) == ffmpeg ]] || fail "flaneur does not recommend ffmpeg"
# The libraries: whatever a user's program is linked with has its development package.
config=$folder/root/usr/lib/cmake/flaneur
links=$(sed -nE 's/^ *"[a-z0-9]+ ([A-Za-z0-9_]+) [^ ]+ ([a-z0-9.-]+)"\)?$/\1 \2/p' "$config/flaneur-dependencies.cmake")
[[ $(wc -l <<< "$links") -ge 13 ]] || fail "flaneur-dependencies.cmake is not as expected"
while read -r library package; do
    depends "$dev" | grep -x "$package" > /dev/null || fail "libflaneur-dev does not depend on $package"
    dpkg-query --listfiles "$package" | grep -E "/lib$library\.(so|a)$" > /dev/null || fail "$package has no lib$library"
done <<< "$links"

# rendercheck serves without the rest of flaneur.
dpkg-deb --extract "$check" "$folder/alone"
"$folder/alone/usr/bin/rendercheck" --version
[[ $(find "$folder/alone" -type f -path '*bin/*' | wc -l) == 1 ]] || fail "rendercheck brings other programs"
for option in $("$folder/alone/usr/bin/rendercheck" run --help | grep -oE -- '--[a-z-]+' | sort -u); do
    [[ $option == --help ]] || grep -qF -- "${option//-/\\-}" "$folder/alone/usr/share/man/man1/rendercheck.1" ||
        fail "rendercheck's manual page does not tell of $option"
done
# What was unpacked serves.
usr=$folder/root/usr
if [[ -n $python ]]; then
    [[ -s $usr/share/doc/python3-flaneur/copyright && -e $usr/lib/python3/dist-packages/flaneur/py.typed ]] || fail "python3-flaneur"
    told=$(PATH=$usr/bin:$PATH PYTHONPATH=$usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c "
import flaneur
world = flaneur.World('corner', walkers=20)
world.step(60)
print(f'{world.hash():016x}', flaneur.program())")
    [[ $told == "$("$usr/bin/flaneur" sim --scene corner --walkers 20 --seconds 1 --hash 2> /dev/null) $usr/bin/flaneur" ]] ||
        fail "python3-flaneur: $told"
fi
"$usr/bin/flaneur" sim --scene corner --walkers 20 --seconds 1 --hash
for file in bin/flaneur share/man/man1/flaneur.1.gz share/applications/flaneur.desktop \
    share/icons/hicolor/scalable/apps/flaneur.svg share/bash-completion/completions/flaneur \
    share/zsh/vendor-completions/_flaneur share/fish/vendor_completions.d/flaneur.fish share/doc/flaneur/copyright \
    share/doc/flaneur/THIRD_PARTY.md share/doc/libflaneur-dev/copyright share/doc/libflaneur-dev/examples/walkers/main.cpp; do
    [[ -s $usr/$file ]] || fail "no /usr/$file"
done
desktop-file-validate "$usr/share/applications/flaneur.desktop" || fail "the desktop entry"
cmake -S "$usr/share/doc/libflaneur-dev/examples/walkers" -B "$folder/walkers" -DCMAKE_PREFIX_PATH="$usr" > "$folder/log" 2>&1 &&
    cmake --build "$folder/walkers" >> "$folder/log" 2>&1 || { cat "$folder/log" && fail "the example walkers"; }
"$folder/walkers/walkers" | tail -1
