# What flaneur's libraries are linked with, found in the same way when they are built and when they are used: this file
# is installed beside flaneur-config.cmake.
#     target  library ("-": headers alone)  header  Debian's package
set(flaneur_sim_links
    "recast Recast recastnavigation/Recast.h librecast-dev"
    "detour Detour recastnavigation/DetourNavMesh.h librecast-dev"
    "highway hwy hwy/highway.h libhwy-dev")
set(flaneur_assets_links
    "bzip2 bz2 bzlib.h libbz2-dev"
    "draco draco draco/compression/decode.h libdraco-dev"
    "expat expat expat.h libexpat1-dev"
    "jpeg jpeg jpeglib.h libjpeg62-turbo-dev"
    "meshoptimizer meshoptimizer meshoptimizer.h libmeshoptimizer-dev"
    "png png png.h libpng-dev"
    "polyclipping polyclipping polyclipping/clipper.hpp libpolyclipping-dev"
    "sqlite sqlite3 sqlite3.h libsqlite3-dev"
    "stb stb stb/stb_image.h libstb-dev"
    "tiff tiff tiffio.h libtiff-dev"
    "tinygltf tinygltf tiny_gltf.h libtinygltf-dev"
    "webp webp webp/decode.h libwebp-dev"
    "zip zip zip.h libzip-dev"
    "zlib z zlib.h zlib1g-dev"
    "zstd zstd zstd.h libzstd-dev")
set(flaneur_renderer_links
    "glfw glfw GLFW/glfw3.h libglfw3-dev"
    "glm - glm/glm.hpp libglm-dev")
set(flaneur_extract_links ${flaneur_sim_links} ${flaneur_assets_links} ${flaneur_renderer_links})

# flaneur_find(missing component): makes flaneur::recast and so on, and appends the Debian packages of what is not here.
function(flaneur_find missing component)
    set(lacks ${${missing}})
    foreach(row IN LISTS flaneur_${component}_links)
        string(REPLACE " " ";" row "${row}")
        list(GET row 0 name)
        list(GET row 1 library)
        list(GET row 2 header)
        list(GET row 3 package)
        if(TARGET flaneur::${name})
            continue()
        endif()
        find_path(FLANEUR_${name}_INCLUDE ${header} PATH_SUFFIXES ${name})
        mark_as_advanced(FLANEUR_${name}_INCLUDE)
        if(NOT FLANEUR_${name}_INCLUDE)
            list(APPEND lacks ${package})
            continue()
        endif()
        if(library STREQUAL "-")
            add_library(flaneur::${name} INTERFACE IMPORTED GLOBAL)
        else()
            find_library(FLANEUR_${name}_LIBRARY ${library})
            mark_as_advanced(FLANEUR_${name}_LIBRARY)
            if(NOT FLANEUR_${name}_LIBRARY)
                list(APPEND lacks ${package})
                continue()
            endif()
            add_library(flaneur::${name} UNKNOWN IMPORTED GLOBAL)
            set_target_properties(flaneur::${name} PROPERTIES IMPORTED_LOCATION ${FLANEUR_${name}_LIBRARY})
        endif()
        set_target_properties(flaneur::${name} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${FLANEUR_${name}_INCLUDE})
    endforeach()
    set(${missing} ${lacks} PARENT_SCOPE)
endfunction()
