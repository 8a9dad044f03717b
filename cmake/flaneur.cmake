# How every target of the project is built. Of this nothing reaches those who link the libraries.
if((CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12) OR
   (CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14))
    message(FATAL_ERROR "flaneur takes GCC 12 or Clang 14, or newer; this is ${CMAKE_CXX_COMPILER_ID} "
        "${CMAKE_CXX_COMPILER_VERSION}. Say which to use with -DCMAKE_CXX_COMPILER=...")
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

include_directories(${PROJECT_SOURCE_DIR})
if(PROJECT_IS_TOP_LEVEL)
    add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
endif()
if(FLANEUR_WERROR)
    add_compile_options(-Werror)
endif()
# The same bits from every compiler and instruction set: see docs/determinism.md.
add_compile_options(-ffp-contract=off -fno-fast-math)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
    # What Highway compiles NEON kernels for; plain functions that call one on a single lane must agree.
    add_compile_options(-march=armv8-a+crypto)
    # Vectors without a fixed size cannot be members of Lanes.
    add_compile_definitions("HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
endif()

set(FLANEUR_SANITIZE "" CACHE STRING "Sanitizers to build with: address,undefined or thread")
if(FLANEUR_SANITIZE)
    add_compile_options(-fsanitize=${FLANEUR_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${FLANEUR_SANITIZE})
    # One lane wide: the same formulas, and minutes less to compile with every operation instrumented.
    add_compile_definitions(HWY_COMPILE_ONLY_SCALAR)
endif()

# What is built with, all of it looked for before anything is said.
find_package(Threads REQUIRED)
include(cmake/dependencies.cmake)
set(FLANEUR_MISSING "")
flaneur_find(FLANEUR_MISSING sim)
flaneur_find(FLANEUR_MISSING assets)
if(FLANEUR_VULKAN)
    flaneur_find(FLANEUR_MISSING renderer)
endif()
# flaneur_need(HEADER|PROGRAM name file package): FLANEUR_name is the header's folder or the program.
macro(flaneur_need kind name file package)
    if(${kind} STREQUAL PROGRAM)
        find_program(FLANEUR_${name} ${file})
    else()
        find_path(FLANEUR_${name} ${file})
    endif()
    mark_as_advanced(FLANEUR_${name})
    if(NOT FLANEUR_${name})
        list(APPEND FLANEUR_MISSING ${package})
    endif()
endmacro()
flaneur_need(HEADER OSMIUM_INCLUDE osmium/version.hpp libosmium2-dev)
flaneur_need(HEADER JSON_INCLUDE nlohmann/json.hpp nlohmann-json3-dev)
if(FLANEUR_VULKAN)
    flaneur_need(HEADER VULKAN_INCLUDE vulkan/vulkan.h libvulkan-dev)  # volk loads the library at run time
    flaneur_need(HEADER VOLK_INCLUDE volk.h libvulkan-volk-dev)
    flaneur_need(PROGRAM GLSLANG glslangValidator glslang-tools)
endif()
if(FLANEUR_PROGRAM)
    flaneur_need(HEADER CLI11_INCLUDE CLI/CLI.hpp libcli11-dev)
endif()
if(FLANEUR_PROGRAM AND FLANEUR_VULKAN)
    set(flaneur_program_links
        "imgui imgui imgui.h libimgui-dev"
        "OpenEXR OpenEXR ImfInputFile.h libopenexr-dev"
        "Imath Imath ImathBox.h libimath-dev")
    flaneur_find(FLANEUR_MISSING program)
    find_path(FLANEUR_LETTERS DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu)
    mark_as_advanced(FLANEUR_LETTERS)
    if(NOT FLANEUR_LETTERS)
        list(APPEND FLANEUR_MISSING fonts-dejavu-core)
    endif()
endif()
if(FLANEUR_TESTS)
    flaneur_need(HEADER GTEST_INCLUDE gtest/gtest.h libgtest-dev)
endif()
if(FLANEUR_MISSING)
    list(REMOVE_DUPLICATES FLANEUR_MISSING)
    list(SORT FLANEUR_MISSING)
    list(JOIN FLANEUR_MISSING " " FLANEUR_MISSING)
    message(FATAL_ERROR "flaneur is built from libraries and programs that this machine lacks. On Debian:\n"
        "  apt install ${FLANEUR_MISSING}\n"
        "-DFLANEUR_VULKAN=OFF builds what draws nothing, and -DFLANEUR_TESTS=OFF no tests; each takes less.")
endif()

# flaneur_batch(target): sources that do not take each other's names are compiled as one, as most of what a source takes to
# compile is the headers that it shares with its neighbours. Without, a build of everything takes three times as long.
find_package(Python3 COMPONENTS Interpreter QUIET)
option(FLANEUR_BATCH "Compile several sources as one; takes Python" ${Python3_FOUND})
function(flaneur_batch target)
    if(NOT FLANEUR_BATCH OR NOT PROJECT_IS_TOP_LEVEL)
        return()
    endif()
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "^[^/.].*[.]cpp$")  # neither others' nor what is made in the build
    list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/batches.py ${PROJECT_SOURCE_DIR} ${sources}
        OUTPUT_VARIABLE batches COMMAND_ERROR_IS_FATAL ANY)
    string(STRIP "${batches}" batches)
    string(REPLACE "\n" ";" batches "${batches}")
    set(number 0)
    foreach(batch IN LISTS batches)
        string(REPLACE " " ";" batch "${batch}")
        set_source_files_properties(${batch} PROPERTIES UNITY_GROUP ${target}_${number})
        math(EXPR number "${number} + 1")
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # A name of one source hides, and is hidden by, those of others.
    target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/batches.py)
endfunction()

# flaneur_hardly_runs(target): what takes longer to compile than it runs is, for sanitizers, compiled as it stands.
function(flaneur_hardly_runs target)
    if(FLANEUR_SANITIZE)
        target_compile_options(${target} PRIVATE -O0)
    endif()
endfunction()

# flaneur_library(name SOURCES file... LINK target... [PUBLIC target...] [HEADERS file...]): flaneur::name, in which
# HEADERS are what users include, and what these include.
function(flaneur_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PUBLIC;HEADERS" ${ARGN})
    add_library(flaneur_${name} STATIC ${ARG_SOURCES})
    add_library(flaneur::${name} ALIAS flaneur_${name})
    set_target_properties(flaneur_${name} PROPERTIES EXPORT_NAME ${name})
    target_compile_features(flaneur_${name} PUBLIC cxx_std_20)
    target_link_libraries(flaneur_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_LINK})
    flaneur_batch(flaneur_${name})
    if(NOT PROJECT_IS_TOP_LEVEL)
        target_include_directories(flaneur_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
    endif()
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    list(TRANSFORM ARG_HEADERS PREPEND ${folder}/)
    set_property(GLOBAL APPEND PROPERTY FLANEUR_HEADERS ${ARG_HEADERS})
    set_property(GLOBAL APPEND PROPERTY FLANEUR_LIBRARIES ${name})
endfunction()
