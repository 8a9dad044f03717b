# Settings that every target of the project is built with.
add_library(flaneur_settings INTERFACE)
target_include_directories(flaneur_settings INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(flaneur_settings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
    # The same bits from every compiler and instruction set: see docs/determinism.md.
    -ffp-contract=off -fno-fast-math)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
    # What Highway compiles NEON kernels for; plain functions that call one on a single lane must agree.
    target_compile_options(flaneur_settings INTERFACE -march=armv8-a+crypto)
    # Vectors without a fixed size cannot be members of Lanes.
    target_compile_definitions(flaneur_settings INTERFACE
        "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
endif()

set(FLANEUR_SANITIZE "" CACHE STRING "Sanitizers to build with: address,undefined or thread")
if(FLANEUR_SANITIZE)
    target_compile_options(flaneur_settings INTERFACE
        -fsanitize=${FLANEUR_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(flaneur_settings INTERFACE -fsanitize=${FLANEUR_SANITIZE})
    # One lane wide: the same formulas, and minutes less to compile with every operation instrumented.
    target_compile_definitions(flaneur_settings INTERFACE HWY_COMPILE_ONLY_SCALAR)
endif()

# flaneur_library(name SOURCES file... LINK target...)
function(flaneur_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
    add_library(${name} STATIC ${ARG_SOURCES})
    target_link_libraries(${name} PUBLIC flaneur_settings ${ARG_LINK})
endfunction()

# flaneur_test(name SOURCES file... LINK target...): a GoogleTest program, each case a CTest test.
function(flaneur_test name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE ${ARG_LINK} GTest::gtest_main)
    gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
