# SPDX-License-Identifier: Apache-2.0
# Compiles the kernel source once per fractal, precision and mode.

include_guard()
include(Fractals)

# GCC's SRA has a size limit that packs exceed; raise it so that they stay in registers.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # A lower limit for alias queries (default 1000) gives the same code in a quarter of the compile time.
    # -fipa-pure-const makes loops of the Mandelbox slower in exact mode (docs/notes/experiments.md), and GCC 12 crashes
    # (in fre, when it compares calls of pure functions) on packs of a single instruction set.
    set(MANDELMARCH_PACKS --param=sra-max-scalarization-size-Ospeed=8192 --param=sra-max-propagations=1000
        --param=sccvn-max-alias-queries-per-access=100 -fno-ipa-pure-const)
endif()
# For Clang, packs do not force inlining of the kernel (core/kernel/prelude/pack.h). With this threshold it inlines the
# same functions that GCC is forced to inline.
set(MANDELMARCH_INLINING "")
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    set(MANDELMARCH_INLINING -mllvm -inline-threshold=5000)
endif()
# In fast mode packs fuse explicitly (core/kernel/prelude/pack.h), in the same way for every register width.
set(MANDELMARCH_PACKS -ffp-contract=off ${MANDELMARCH_PACKS} ${MANDELMARCH_INLINING})

# mandelmarch_kernel_variants(TARGET TEMPLATE [OPTIONS FLAG...]): adds TEMPLATE.cpp.in, configured for every fractal,
# precision and mode, to the target, each with its mode's floating-point flags, followed by the options. The template
# can use fractal, fractal_file, precision, is_float, mode, is_fast and file.
function(mandelmarch_kernel_variants target template)
    cmake_parse_arguments(PARSE_ARGV 2 with "" "" "OPTIONS")
    if(with_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "mandelmarch_kernel_variants(${target} ${template}): what is '${with_UNPARSED_ARGUMENTS}'?")
    endif()
    cmake_path(GET template FILENAME name)
    foreach(fractal ${MANDELMARCH_FRACTALS})
        set(fractal_file ${MANDELMARCH_TEXT_${fractal}})
        foreach(precision float double)
            foreach(mode exact fast)
                string(COMPARE EQUAL ${precision} float is_float)
                string(COMPARE EQUAL ${mode} fast is_fast)
                set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_${fractal}_${precision}_${mode}.cpp)
                configure_file(${template}.cpp.in ${file} @ONLY)
                target_sources(${target} PRIVATE ${file})
                set_source_files_properties(${file} PROPERTIES
                    COMPILE_OPTIONS "${MANDELMARCH_FP_${mode}};${with_OPTIONS}")
            endforeach()
        endforeach()
    endforeach()
endfunction()
