# `cpack` in a build folder makes the Debian packages flaneur, rendercheck, python3-flaneur and libflaneur-dev.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The flaneur authors")
set(CPACK_PACKAGE_CONTACT "The flaneur authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own first line
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

if(FLANEUR_PROGRAM)
    list(APPEND CPACK_COMPONENTS_ALL program)
    set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME flaneur)
    set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
    set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "viewer of crowds that walk about a city
Fills a generated district or a place from OpenStreetMap with hundreds to a
hundred thousand people, feet planted, and draws them with Vulkan on a GPU or
on none: in a window, as pictures or as films. The same seed gives the same
run to the last bit on every x86-64 machine.")
    set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
    if(FLANEUR_VULKAN)
        # Loaded at run time: Vulkan's loader, and a driver, of which lavapipe needs no GPU.
        set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd")
        set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS ffmpeg)
        set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS librenderdoc)
    endif()
endif()

if(FLANEUR_PROGRAM AND FLANEUR_VULKAN)
    list(APPEND CPACK_COMPONENTS_ALL rendercheck)
    set(CPACK_DEBIAN_RENDERCHECK_PACKAGE_NAME rendercheck)
    set(CPACK_DEBIAN_RENDERCHECK_PACKAGE_SECTION graphics)
    set(CPACK_DEBIAN_RENDERCHECK_DESCRIPTION "renders by any program, held against references
Runs commands that write pictures and judges these by a verdict that neither
flickers nor sleeps: one far thing missing is seen, a CPU's rounding is not.
Tells what differs and where, as text, JUnit and a page to look at.")
    set(CPACK_DEBIAN_RENDERCHECK_PACKAGE_SHLIBDEPS ON)
    # Vulkan is asked which device draws, where there is any.
    set(CPACK_DEBIAN_RENDERCHECK_PACKAGE_RECOMMENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd")
endif()

if(FLANEUR_PYTHON)
    list(APPEND CPACK_COMPONENTS_ALL python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-flaneur)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_DESCRIPTION "crowds that walk, and trajectories of people, for Python
Simulates people in a city, reads and writes trajectories of PeTrack, JuPedSim,
SUMO, Vadere and others as frames of pandas, measures density, speed and flow,
and shows them in a notebook as people who walk, with a GPU or without one.")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
    # The module serves the Python that it was compiled for alone.
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3 (>= ${FLANEUR_PYTHON_VERSION}), python3 (<< ${FLANEUR_PYTHON_NEXT}), python3-numpy, python3-pandas")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "flaneur, ffmpeg")
endif()

# Those who link static libraries link all that these are linked with.
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libflaneur-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION "crowds that walk about a city, as libraries
Static libraries, headers and a CMake package: flaneur::sim lets people walk
on your ground in your skeletons, bit for bit the same on every x86-64 machine;
flaneur::assets makes and reads cities and people; flaneur::renderer draws them
with Vulkan, of what flaneur::extract makes of both. With examples.")
set(needed "")
foreach(library IN LISTS FLANEUR_LIBRARIES)
    foreach(row IN LISTS flaneur_${library}_links)
        string(REGEX REPLACE ".* " "" package "${row}")
        list(APPEND needed ${package})
    endforeach()
endforeach()
list(REMOVE_DUPLICATES needed)
list(SORT needed)
list(JOIN needed ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "cmake, g++ (>= 12) | clang (>= 14)")
include(CPack)
