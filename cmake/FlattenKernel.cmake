# SPDX-License-Identifier: Apache-2.0
# Makes the kernel source one string with all #includes expanded, for compilers that take strings, not files. A script
# of the report's viewer (cmake -P) also includes this file. A script cannot make CMake configure again if a source
# changes, so scripts skip the next lines.
if(NOT CMAKE_SCRIPT_MODE_FILE)
    file(GLOB_RECURSE kernel_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/kernel/*.h)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${kernel_files})
endif()

# mandelmarch_flatten_kernel(ROOT FRACTAL RESULT): stores in RESULT the text of the file ROOT (relative to the project)
# with all #includes expanded. `#include MM_FRACTAL_FILE` becomes the kernel source of FRACTAL.
function(mandelmarch_flatten_kernel root fractal result)
    if(NOT CMAKE_SCRIPT_MODE_FILE)
        set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${root})
    endif()
    file(READ ${PROJECT_SOURCE_DIR}/${root} text)
    while(text MATCHES "#include (\"([^\"\n]+)\"|MM_FRACTAL_FILE)\n")
        set(line "${CMAKE_MATCH_0}")
        set(file "${CMAKE_MATCH_2}")
        if(file STREQUAL "")
            set(file ${MANDELMARCH_TEXT_${fractal}})
        endif()
        cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE whole)
        file(READ ${whole} included)
        string(REPLACE "${line}" "// ---- ${file}\n${included}" text "${text}")
    endwhile()
    set(${result} "${text}" PARENT_SCOPE)
endfunction()

# mandelmarch_flatten_glsl(ROOT FRACTAL FILE): writes the shader ROOT, specialised for FRACTAL, to FILE. A macro cannot
# append a suffix to a number in glslang, so this function does it: R(x) becomes BY_PRECISION(x, x), and
# BY_PRECISION(x, y) becomes BY_PRECISION(xlf, yf).
function(mandelmarch_flatten_glsl root fractal file)
    mandelmarch_flatten_kernel(${root} "${fractal}" text)
    set(number "(-?[0-9.]+(e-?[0-9]+)?)")
    string(REGEX REPLACE "([^A-Z_])R\\(${number}\\)" "\\1BY_PRECISION(\\2, \\2)" text "${text}")
    string(REGEX REPLACE "BY_PRECISION\\(${number}, ${number}\\)" "BY_PRECISION(\\1lf, \\3f)" text "${text}")
    if(text MATCHES "[^A-Z_]R\\([^)]*\\)?")
        message(FATAL_ERROR "${root}, ${fractal}: ${CMAKE_MATCH_0}: expected a decimal literal such as R(0.5) or R(1.0e-3)")
    endif()
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
endfunction()
