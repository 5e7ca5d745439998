# SPDX-License-Identifier: Apache-2.0
# Installs the programs with their manual pages and the official parameter files, and the libraries with their headers
# as the package mandelmarch: find_package(mandelmarch), target_link_libraries(x mandelmarch::backends); or, without
# CMake, pkg-config --cflags --libs mandelmarch.
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
file(GLOB looks ${PROJECT_SOURCE_DIR}/scenes/*.look)
install(FILES ${looks} DESTINATION ${CMAKE_INSTALL_DATADIR}/mandelmarch/looks)
install(FILES LICENSE README.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The schemas of bench's files, as `bench schema KIND` prints them.
if(TARGET bench AND NOT CMAKE_CROSSCOMPILING)
    foreach(kind result random equivalence portability)
        set(schema ${CMAKE_CURRENT_BINARY_DIR}/schemas/${kind}.schema.json)
        install(CODE "
            execute_process(COMMAND \"$<TARGET_FILE:bench>\" schema ${kind} OUTPUT_FILE \"${schema}\" COMMAND_ERROR_IS_FATAL ANY)")
        install(FILES ${schema} DESTINATION ${CMAKE_INSTALL_DATADIR}/mandelmarch/schemas)
    endforeach()
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/schemas)
endif()
# Manual pages are made from the help texts, if help2man is installed. A help text begins with "PROGRAM: ", and a
# description of the program.
find_program(help2man help2man)
mark_as_advanced(help2man)
if(help2man AND NOT CMAKE_CROSSCOMPILING)
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/man)
    foreach(program ${programs})
        set(page ${CMAKE_CURRENT_BINARY_DIR}/man/${program}.1)
        install(CODE "
            set(program \"$<TARGET_FILE:${program}>\")
            execute_process(COMMAND \"\${program}\" --help OUTPUT_VARIABLE help)
            string(REGEX MATCH \"^[^:]*: ([^\n]*)[.]\n\" line \"\${help}\")
            execute_process(COMMAND \"${help2man}\" --no-info --name \"\${CMAKE_MATCH_1}\"
                --version-string ${PROJECT_VERSION} --output \"${page}\" \"\${program}\")")
        install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
    endforeach()
endif()
list(TRANSFORM MANDELMARCH_BUILT PREPEND mandelmarch_ OUTPUT_VARIABLE backend_targets)
install(TARGETS mandelmarch_core mandelmarch_instruments mandelmarch_version mandelmarch_backends mandelmarch_warnings ${backend_targets}
    EXPORT mandelmarch ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core ${PROJECT_SOURCE_DIR}/backends
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mandelmarch FILES_MATCHING PATTERN "*.h" PATTERN "core/scene/fractals" EXCLUDE)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/mandelmarch)
install(EXPORT mandelmarch NAMESPACE mandelmarch:: FILE mandelmarchTargets.cmake DESTINATION ${package_folder})
get_property(dependencies GLOBAL PROPERTY MANDELMARCH_DEPENDENCIES)
list(REMOVE_DUPLICATES dependencies)
list(JOIN dependencies "\n" dependencies)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/mandelmarchConfig.cmake @ONLY CONTENT [[
# SPDX-License-Identifier: Apache-2.0
include(CMakeFindDependencyMacro)
find_dependency(fmt)
find_dependency(JPEG)
find_dependency(PNG)
find_dependency(OpenEXR CONFIG)
# Dependencies of the backends in this build.
@dependencies@
include(${CMAKE_CURRENT_LIST_DIR}/mandelmarchTargets.cmake)
]])
write_basic_package_version_file(mandelmarchConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mandelmarchConfig.cmake ${PROJECT_BINARY_DIR}/mandelmarchConfigVersion.cmake
    DESTINATION ${package_folder})
# mandelmarch.pc names libraries and headers relative to its own folder, so that an installation can be moved.
list(TRANSFORM MANDELMARCH_BUILT PREPEND -lmandelmarch_ OUTPUT_VARIABLE libraries)
get_property(words GLOBAL PROPERTY MANDELMARCH_PKG_CONFIG)
set(packages ${words})
list(FILTER packages INCLUDE REGEX "^[A-Za-z]")
list(FILTER words EXCLUDE REGEX "^[A-Za-z]")
foreach(target ${backend_targets})
    list(APPEND words "$<JOIN:$<TARGET_PROPERTY:${target},INTERFACE_LINK_OPTIONS>, >")
endforeach()
foreach(list libraries packages words)
    list(JOIN ${list} " " ${list})
endforeach()
file(RELATIVE_PATH include ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR}/mandelmarch)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/mandelmarch.pc.in @ONLY CONTENT [[
# SPDX-License-Identifier: Apache-2.0
libdir=${pcfiledir}/..
includedir=${pcfiledir}/@include@

Name: @PROJECT_NAME@
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Requires: fmt libjpeg libpng OpenEXR @packages@
Libs: -L${libdir} -lmandelmarch_backends @libraries@ -lmandelmarch_instruments -lmandelmarch_core @words@ -ldl
Cflags: -std=c++20 -I${includedir}
]])
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/mandelmarch.pc INPUT ${PROJECT_BINARY_DIR}/mandelmarch.pc.in)
install(FILES ${PROJECT_BINARY_DIR}/mandelmarch.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
