#!/bin/bash
# aarch64.sh ROOT FOLDER: cross-builds flaneur, without drawing, in FOLDER and writes FOLDER/flaneur, which runs it under
# qemu. Debian's arm64 packages are unpacked in FOLDER/root; nothing is installed. Skips, with 77, where they are not to
# be had.
set -euo pipefail
skip() { echo "SKIPPED: $*" && exit 77; }
root=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
for program in apt-get dpkg-source aarch64-linux-gnu-g++ qemu-aarch64; do
    command -v $program > /dev/null || skip "no $program here; tools/packages test installs it."
done

# apt with arm64 as its own and only architecture, and a state of its own.
apt=$folder/apt arm64=$folder/root
libraries=$arm64/usr/lib/aarch64-linux-gnu
packages=(libboost1.74-dev libbz2-1.0 libbz2-dev libcli11-dev libdraco7 libdraco-dev libexpat1 libexpat1-dev libhwy1 libhwy-dev liblz4-dev
          libmeshoptimizer2d libmeshoptimizer-dev libosmium2-dev libpolyclipping22 libpolyclipping-dev libprotozero-dev
          librecast1 librecast-dev libstb0 libstb-dev libtinygltf2d libtinygltf-dev nlohmann-json3-dev zlib1g zlib1g-dev
          libtiff6 libtiff-dev libdeflate0 libjbig0 libjpeg62-turbo liblerc4 liblzma5 libwebp7 libzstd1
          libzip4 libzip-dev libssl3)
if [[ ! -e $arm64/complete || $(<"$arm64/complete") != "${packages[*]}" ]]; then
    rm -rf "$apt" "$arm64"
    mkdir -p "$apt"/{state/lists/partial,cache/archives/partial,sources,debs} "$arm64"
    touch "$apt/status"
    for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
        if [[ ! -e $list ]]; then continue; fi
        sed -E 's/^Types: deb$/Types: deb deb-src/; s/^deb (.*)/deb \1\ndeb-src \1/' "$list" \
            > "$apt/sources/$(basename "$list")"
    done
    cat > "$apt/apt.conf" << END
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "root";
Dir::State "$apt/state";
Dir::State::status "$apt/status";
Dir::Cache "$apt/cache";
Dir::Etc::sourcelist "/dev/null";
Dir::Etc::sourceparts "$apt/sources";
END
    export APT_CONFIG=$apt/apt.conf
    cd "$apt/debs"
    apt-get update --quiet || skip "apt cannot read the lists of arm64."
    apt-get download --quiet "${packages[@]}" || skip "apt has not all arm64 packages."
    for deb in *.deb; do dpkg-deb --extract "$deb" "$arm64"; done
    cp -a "$arm64"/lib/. "$arm64/usr/lib/"
    find "$libraries" -type l -lname '/*' -printf '%f %l\n' |
        while read -r link target; do ln -sf "$(basename "$target")" "$libraries/$link"; done
    # Debian's arm64 build of Recast and Detour fuses multiplications with additions, which rounds differently.
    if apt-get source --quiet recastnavigation; then
        rm "$libraries"/lib{Recast,Detour}.so.1*
        for library in Recast Detour; do
            aarch64-linux-gnu-g++ -O2 -DNDEBUG -fPIC -ffp-contract=off -shared -Wl,-soname,lib$library.so.1 \
                -o "$libraries/lib$library.so.1" -I"$arm64/usr/include/recastnavigation" \
                recastnavigation-*/$library/Source/*.cpp
        done
        touch "$arm64/unfused"
    fi
    echo "${packages[*]}" > "$arm64/complete"
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
