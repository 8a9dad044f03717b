# What is installed: the libraries, as a package that find_package(flaneur) finds wherever the prefix is moved to, and
# the program. And the headers as users see them, in the build folder, for those who take flaneur in by FetchContent.
get_property(FLANEUR_HEADERS GLOBAL PROPERTY FLANEUR_HEADERS)
get_property(FLANEUR_LIBRARIES GLOBAL PROPERTY FLANEUR_LIBRARIES)
file(GLOB_RECURSE INSTALLABLE CONFIGURE_DEPENDS sim/*.h assets/*.h renderer/*.h shaders/*.h tools/extract/*.h)
set(HEADERS_STAMP ${PROJECT_BINARY_DIR}/include/stamp)
add_custom_command(
    OUTPUT ${HEADERS_STAMP}
    COMMAND ${CMAKE_COMMAND} -DFROM=${PROJECT_SOURCE_DIR} -DTO=${PROJECT_BINARY_DIR}/include
            "-DHEADERS=${FLANEUR_HEADERS}" -P ${PROJECT_SOURCE_DIR}/cmake/headers.cmake
    COMMAND ${CMAKE_COMMAND} -E touch ${HEADERS_STAMP}
    DEPENDS ${INSTALLABLE} ${PROJECT_SOURCE_DIR}/cmake/headers.cmake
    COMMENT "Gathering the public headers"
    VERBATIM)
add_custom_target(flaneur_headers ALL DEPENDS ${HEADERS_STAMP})
foreach(library IN LISTS FLANEUR_LIBRARIES)
    add_dependencies(flaneur_${library} flaneur_headers)
endforeach()

if(NOT FLANEUR_INSTALL)
    return()
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# libflaneur-dev
set(CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/flaneur)
foreach(library IN LISTS FLANEUR_LIBRARIES)
    install(TARGETS flaneur_${library} EXPORT flaneur-${library}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    install(EXPORT flaneur-${library} NAMESPACE flaneur:: DESTINATION ${CONFIG_DIR} COMPONENT dev)
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/include/flaneur DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
configure_package_config_file(cmake/flaneur-config.cmake.in ${PROJECT_BINARY_DIR}/package/flaneur-config.cmake
    INSTALL_DESTINATION ${CONFIG_DIR} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/flaneur-config-version.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/flaneur-config.cmake
              ${PROJECT_BINARY_DIR}/package/flaneur-config-version.cmake
        DESTINATION ${CONFIG_DIR} COMPONENT dev)
install(FILES cmake/dependencies.cmake DESTINATION ${CONFIG_DIR} RENAME flaneur-dependencies.cmake COMPONENT dev)

install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libflaneur-dev COMPONENT dev PATTERN notebook EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libflaneur-dev RENAME copyright COMPONENT dev)
install(FILES THIRD_PARTY.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libflaneur-dev COMPONENT dev)

# flaneur. What is written from `flaneur --help` takes a program that runs here.
if(FLANEUR_PROGRAM)
    install(TARGETS flaneur RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
    install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/flaneur RENAME copyright COMPONENT program)
    install(FILES THIRD_PARTY.md CHANGELOG.md README.md
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/flaneur COMPONENT program)
    file(GLOB PAGES CONFIGURE_DEPENDS docs/*.md)
    install(FILES ${PAGES} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/flaneur/docs COMPONENT program)
    install(DIRECTORY docs/life DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/flaneur/docs COMPONENT program)
    install(DIRECTORY assets/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/flaneur COMPONENT program)
    if(FLANEUR_VULKAN)
        install(FILES packaging/flaneur.desktop
            DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)
        install(FILES packaging/flaneur.svg
            DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT program)
    endif()
    if(NOT CMAKE_CROSSCOMPILING)
        set(PAGES_DIR ${PROJECT_BINARY_DIR}/pages)
        add_custom_command(
            OUTPUT ${PAGES_DIR}/flaneur.1 ${PAGES_DIR}/flaneur.1.gz ${PAGES_DIR}/flaneur.bash ${PAGES_DIR}/_flaneur
                   ${PAGES_DIR}/flaneur.fish
            COMMAND ${PROJECT_SOURCE_DIR}/packaging/pages $<TARGET_FILE:flaneur> ${PROJECT_VERSION} ${PAGES_DIR}
            DEPENDS flaneur packaging/pages packaging/manual.awk packaging/manual.roff packaging/flaneur.bash
                    packaging/flaneur.zsh packaging/fish.awk
            COMMENT "Writing the manual page and the completions"
            VERBATIM)
        add_custom_target(flaneur_pages ALL DEPENDS ${PAGES_DIR}/flaneur.1)
        install(FILES ${PAGES_DIR}/flaneur.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
        install(FILES ${PAGES_DIR}/flaneur.bash RENAME flaneur
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
        install(FILES ${PAGES_DIR}/_flaneur
            DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
        install(FILES ${PAGES_DIR}/flaneur.fish
            DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
    endif()
endif()

# python3-flaneur: where Debian's Python looks, and below another prefix for PYTHONPATH.
if(FLANEUR_PYTHON)
    set(PYTHON_DIR lib/python3/dist-packages/flaneur)
    install(TARGETS flaneur_python LIBRARY DESTINATION ${PYTHON_DIR} COMPONENT python)
    install(DIRECTORY python/flaneur/ DESTINATION ${PYTHON_DIR} COMPONENT python FILES_MATCHING PATTERN *.py PATTERN *.pyi
        PATTERN py.typed PATTERN __pycache__ EXCLUDE)
    install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-flaneur RENAME copyright COMPONENT python)
    install(FILES THIRD_PARTY.md docs/python.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-flaneur COMPONENT python)
    install(DIRECTORY examples/notebook DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-flaneur/examples COMPONENT python)
endif()

# rendercheck
if(FLANEUR_PROGRAM AND FLANEUR_VULKAN)
    install(TARGETS rendercheck RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT rendercheck)
    install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/rendercheck RENAME copyright COMPONENT rendercheck)
    install(FILES THIRD_PARTY.md docs/render-checks.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/rendercheck
        COMPONENT rendercheck)
    install(FILES packaging/rendercheck.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT rendercheck)
endif()

if(PROJECT_IS_TOP_LEVEL)
    include(cmake/packages.cmake)
endif()
