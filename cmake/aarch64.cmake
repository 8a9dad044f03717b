# Builds for aarch64 with Debian's cross compiler. FLANEUR_ARM64_ROOT is where the arm64 packages of what flaneur is
# built from are unpacked; tests/whole/aarch64.sh does so.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FLANEUR_ARM64_ROOT)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_FIND_ROOT_PATH ${FLANEUR_ARM64_ROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Where libraries that libraries need are looked for.
set(CMAKE_EXE_LINKER_FLAGS_INIT -Wl,-rpath-link,${FLANEUR_ARM64_ROOT}/usr/lib/aarch64-linux-gnu)
