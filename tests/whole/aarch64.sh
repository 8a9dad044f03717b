#!/bin/bash
# aarch64.sh ROOT FOLDER: cross-builds flaneur, without drawing, in FOLDER and writes FOLDER/flaneur, which runs it under
# qemu. What tools/arm64 has fetched is unpacked in FOLDER/root; nothing is installed. Skips, with 77, where it has not.
set -euo pipefail
skip() { echo "SKIPPED: $*" && exit 77; }
root=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
for program in dpkg-deb aarch64-linux-gnu-g++ qemu-aarch64; do
    command -v $program > /dev/null || skip "no $program here; tools/packages all installs it, and flaneur was not built for aarch64."
done
fetched=$root/build/arm64
if [[ ! -e $fetched/complete ]]; then
    skip "arm64 packages are not here; tools/packages all fetches them, and flaneur was not built for aarch64."
fi

# Without it no city's hash can be compared, which a build of minutes is for.
recast=("$fetched"/debs/recastnavigation-*/)
if [[ ! -d ${recast[0]} ]]; then
    skip "apt had no source of Recast, whose arm64 build by Debian rounds differently; flaneur was not built for aarch64."
fi

arm64=$folder/root
libraries=$arm64/usr/lib/aarch64-linux-gnu
if ! cmp --silent "$fetched/complete" "$arm64/complete"; then
    rm -rf "$arm64"
    mkdir "$arm64"
    for deb in "$fetched"/debs/*.deb; do dpkg-deb --extract "$deb" "$arm64"; done
    cp -a "$arm64"/lib/. "$arm64/usr/lib/"
    find "$libraries" -type l -lname '/*' -printf '%f %l\n' |
        while read -r link target; do ln -sf "$(basename "$target")" "$libraries/$link"; done
    # Debian's arm64 build of Recast and Detour fuses multiplications with additions, which rounds differently.
    rm "$libraries"/lib{Recast,Detour}.so.1*
    for library in Recast Detour; do
        aarch64-linux-gnu-g++ -O2 -DNDEBUG -fPIC -ffp-contract=off -shared -Wl,-soname,lib$library.so.1 \
            -o "$libraries/lib$library.so.1" -I"$arm64/usr/include/recastnavigation" "${recast[0]}$library"/Source/*.cpp
    done
    cp "$fetched/complete" "$arm64/"
fi

cd "$root"
# At -O1: what comes out is the same, and sooner.
cmake -S . -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" \
    -DCMAKE_TOOLCHAIN_FILE=cmake/aarch64.cmake -DFLANEUR_ARM64_ROOT="$arm64" -DFLANEUR_VULKAN=OFF -DFLANEUR_TESTS=OFF
cmake --build "$folder/build"
cat > "$folder/flaneur" << END
#!/bin/bash
exec qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH="$libraries" "$folder/build/flaneur" "\$@"
END
chmod +x "$folder/flaneur"
