# SPDX-License-Identifier: Apache-2.0
# Installs the programs with their manual pages and the official parameter files, and the libraries with their headers
# as the package mandelmarch: find_package(mandelmarch), target_link_libraries(x mandelmarch::backends).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(programs mandelbulb mandelbox render imgdiff flythrough)
foreach(program demo bench explore)
    if(TARGET ${program})
        list(APPEND programs ${program})
    endif()
endforeach()
install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES paramsBulb.dat paramsBox.dat paramsJulia.dat DESTINATION ${CMAKE_INSTALL_DATADIR}/mandelmarch)
install(FILES LICENSE README.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Manual pages are made from the help texts, if help2man is installed.
find_program(help2man help2man)
mark_as_advanced(help2man)
if(help2man AND NOT CMAKE_CROSSCOMPILING)
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/man)
    foreach(program ${programs})
        set(page ${CMAKE_CURRENT_BINARY_DIR}/man/${program}.1)
        install(CODE "execute_process(COMMAND \"${help2man}\" --no-info --output \"${page}\" \"$<TARGET_FILE:${program}>\")")
        install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
    endforeach()
endif()
list(TRANSFORM MANDELMARCH_BUILT PREPEND mandelmarch_ OUTPUT_VARIABLE backend_targets)
install(TARGETS mandelmarch_core mandelmarch_instruments mandelmarch_version mandelmarch_backends mandelmarch_warnings ${backend_targets}
    EXPORT mandelmarch ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core ${PROJECT_SOURCE_DIR}/instruments ${PROJECT_SOURCE_DIR}/backends
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mandelmarch FILES_MATCHING PATTERN "*.h" PATTERN "core/scene/fractals" EXCLUDE)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/mandelmarch)
install(EXPORT mandelmarch NAMESPACE mandelmarch:: FILE mandelmarchTargets.cmake DESTINATION ${package_folder})
get_property(dependencies GLOBAL PROPERTY MANDELMARCH_DEPENDENCIES)
list(REMOVE_DUPLICATES dependencies)
list(JOIN dependencies "\n" dependencies)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/mandelmarchConfig.cmake.in mandelmarchConfig.cmake
    INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(mandelmarchConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mandelmarchConfig.cmake ${PROJECT_BINARY_DIR}/mandelmarchConfigVersion.cmake
    DESTINATION ${package_folder})
