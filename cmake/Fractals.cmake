# SPDX-License-Identifier: Apache-2.0
# Sets the lists of fractals. MANDELMARCH_FRACTALS has their names. MANDELMARCH_TEXT_NAME is the path of the kernel
# source of the fractal NAME, relative to the project if the file is inside it. MANDELMARCH_ROW_NAME is the path of the
# fractal's descriptor.
option(MANDELMARCH_OWN_FRACTALS "Build the fractals of core/kernel/fractals" ON)
set(MANDELMARCH_MORE_FRACTALS "" CACHE STRING "Folders with more fractals, each of them NAME.h and NAME.cpp")

# mandelmarch_fractals(TEXTS ROWS): adds the fractals with kernel sources TEXTS/NAME.h and descriptors ROWS/NAME.cpp.
function(mandelmarch_fractals texts rows)
    cmake_path(ABSOLUTE_PATH texts BASE_DIRECTORY ${PROJECT_SOURCE_DIR} NORMALIZE)
    cmake_path(ABSOLUTE_PATH rows BASE_DIRECTORY ${PROJECT_SOURCE_DIR} NORMALIZE)
    file(GLOB files CONFIGURE_DEPENDS ${texts}/*.h)
    foreach(text ${files})
        cmake_path(GET text STEM name)
        set(row ${rows}/${name}.cpp)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${text} ${row})
        cmake_path(IS_PREFIX PROJECT_SOURCE_DIR ${text} inside)
        if(inside)
            cmake_path(RELATIVE_PATH text BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
        endif()
        list(APPEND MANDELMARCH_FRACTALS ${name})
        set(MANDELMARCH_TEXT_${name} ${text} PARENT_SCOPE)
        set(MANDELMARCH_ROW_${name} ${row} PARENT_SCOPE)
    endforeach()
    set(MANDELMARCH_FRACTALS ${MANDELMARCH_FRACTALS} PARENT_SCOPE)
endfunction()

set(MANDELMARCH_FRACTALS "")
if(MANDELMARCH_OWN_FRACTALS)
    mandelmarch_fractals(core/kernel/fractals core/scene/fractals)
endif()
foreach(folder ${MANDELMARCH_MORE_FRACTALS})
    mandelmarch_fractals(${folder} ${folder})
endforeach()
