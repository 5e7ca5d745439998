# SPDX-License-Identifier: Apache-2.0
# Lists the fractals. Generates sources from a template, one for each fractal, precision and mode, and a function that
# finds what they define.

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

# The packs of openmp (vectors of pixels) exceed the size limit of GCC's scalar replacement of aggregates (SRA). With
# higher limits they stay in registers.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # With a lower limit of alias queries (default 1000), GCC generates the same code in a quarter of the compile time.
    # -fipa-pure-const makes loops of the Mandelbox slower in exact mode (docs/notes/experiments.md). Also, with
    # -fipa-pure-const, GCC 12 crashes on packs of a single instruction set: its pass fre fails when it compares calls
    # of pure functions.
    set(MANDELMARCH_PACKS --param=sra-max-scalarization-size-Ospeed=8192 --param=sra-max-propagations=1000
        --param=sccvn-max-alias-queries-per-access=100 -fno-ipa-pure-const)
endif()
# GCC is forced to inline the kernel's functions in packs, but Clang is not (core/kernel/prelude/pack.h). With this
# threshold, Clang inlines the same functions.
set(MANDELMARCH_INLINING "")
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    set(MANDELMARCH_INLINING -mllvm -inline-threshold=5000)
endif()
# In fast mode packs fuse operations explicitly, in the same way for every register width (core/kernel/prelude/pack.h).
# Therefore the compiler must not fuse.
set(MANDELMARCH_PACKS -ffp-contract=off ${MANDELMARCH_PACKS} ${MANDELMARCH_INLINING})

# mandelmarch_kernels(TARGET TEMPLATE.cpp.in [BY fractal|precision|mode...] [FRACTALS NAME...] [MODES exact|fast...]
#     [OPTIONS FLAG...] [FOLDER FOLDER] [TABLE FUNCTION CODE TYPE HEADER FILE NAMESPACE NAME]):
# adds sources to the target: TEMPLATE.cpp.in, configured once for every combination of the choices that BY lists (by
# default fractal, precision and mode). The sources are written to FOLDER. Their compiler options are OPTIONS and, if BY
# includes mode, the floating-point flags of the mode. The template can use the variables fractal, fractal_file,
# precision, is_float, mode, is_fast, file (the source's path), variant (FRACTAL_PRECISION_MODE, without the choices
# that are not in BY) and name (TEMPLATE_variant).
# TABLE adds the function `TYPE* FUNCTION(std::string_view variant)` to the namespace NAME. It returns the address of
# the function or constant `TYPE name` that the variant's source defines; nullptr if there is no such variant. FILE is
# the header that declares TYPE. If TYPE contains <Real>, FUNCTION is a template of Real, the precision, and FILE also
# declares this template.
function(mandelmarch_kernels target template)
    cmake_parse_arguments(PARSE_ARGV 2 with "" "FOLDER;TABLE;CODE;HEADER;NAMESPACE" "BY;FRACTALS;MODES;OPTIONS")
    if(with_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "mandelmarch_kernels(${target} ${template}): what is '${with_UNPARSED_ARGUMENTS}'?")
    endif()
    set(usual_BY fractal precision mode)
    set(usual_FRACTALS ${MANDELMARCH_FRACTALS})
    set(usual_MODES exact fast)
    set(usual_FOLDER ${CMAKE_CURRENT_BINARY_DIR})
    foreach(option BY FRACTALS MODES FOLDER)
        if(NOT with_${option})
            set(with_${option} ${usual_${option}})
        endif()
    endforeach()
    set(with_PRECISIONS float double)
    foreach(choice fractal precision mode)
        string(TOUPPER ${choice}S values)
        set(${choice}s once)  # the single value if the sources do not depend on this choice
        if(choice IN_LIST with_BY)
            set(${choice}s ${with_${values}})
        endif()
    endforeach()

    cmake_path(GET template STEM stem)
    set(declarations "")
    set(functions "")
    set(rows "")
    foreach(precision ${precisions})
        string(COMPARE EQUAL ${precision} float is_float)
        string(REPLACE "<Real>" "<${precision}>" code "${with_CODE}")
        foreach(fractal ${fractals})
            set(fractal_file "${MANDELMARCH_TEXT_${fractal}}")
            foreach(mode ${modes})
                string(COMPARE EQUAL ${mode} fast is_fast)
                string(REGEX REPLACE "once_|_once" "" variant ${fractal}_${precision}_${mode})
                set(name ${stem}_${variant})
                set(file ${with_FOLDER}/${name}.cpp)
                configure_file(${template} ${file} @ONLY)
                target_sources(${target} PRIVATE ${file})
                set_source_files_properties(${file} PROPERTIES
                    COMPILE_OPTIONS "${MANDELMARCH_FP_${mode}};${with_OPTIONS}")
                string(APPEND declarations "extern ${code} ${name};\n")
                string(APPEND rows "    if (variant == \"${variant}\") return &${name};\n")
            endforeach()
        endforeach()
        if(with_CODE MATCHES "<Real>")
            string(APPEND functions "template <>\n"
                "${code}* ${with_TABLE}<${precision}>(std::string_view variant)\n{\n${rows}    return nullptr;\n}\n\n")
            set(rows "")
        endif()
    endforeach()
    if(rows)
        set(functions "${with_CODE}* ${with_TABLE}(std::string_view variant)\n{\n${rows}    return nullptr;\n}\n")
    endif()
    if(with_TABLE)
        set(file ${with_FOLDER}/${with_TABLE}.cpp)
        file(CONFIGURE OUTPUT ${file} @ONLY CONTENT [[
// SPDX-License-Identifier: Apache-2.0
// Generated: finds the definitions in the sources that were generated from @stem@.cpp.in.
#include "@with_HEADER@"

namespace @with_NAMESPACE@ {

@declarations@
@functions@
}  // namespace @with_NAMESPACE@
]])
        target_sources(${target} PRIVATE ${file})
        # Excluded from unity builds, in which a specialisation could follow a use of it, which C++ forbids.
        set_source_files_properties(${file} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
endfunction()
