# SPDX-License-Identifier: Apache-2.0
# The kernel text is compiled once per fractal, precision and mode: this file knows the lists and generates the sources.

include_guard()
include(Fractals)

# GCC takes structures of packs apart, into registers, only up to a size that they are beyond by far.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Its value numbering looks for what a load may read among so many stores: fewer than its 1000 leave the same code and
    # a quarter of the time to compile. Knowing that a function is pure it makes slower loops of the Mandelbox in exact mode
    # (docs/notes/experiments.md); GCC 12 crashes (in fre, where it compares calls of pure functions) on packs of one
    # instruction set alone.
    set(MANDELMARCH_PACKS --param=sra-max-scalarization-size-Ospeed=8192 --param=sra-max-propagations=1000
        --param=sccvn-max-alias-queries-per-access=100 -fno-ipa-pure-const)
endif()
# Clang is forced to inline nothing of the kernel text in packs (core/kernel/prelude/pack.h). By this limit it inlines what
# GCC is forced to.
set(MANDELMARCH_INLINING "")
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    set(MANDELMARCH_INLINING -mllvm -inline-threshold=5000)
endif()
# Packs fuse by themselves in fast mode (core/kernel/prelude/pack.h), the same in every register.
set(MANDELMARCH_PACKS -ffp-contract=off ${MANDELMARCH_PACKS} ${MANDELMARCH_INLINING})

# mandelmarch_kernel_variants(TARGET TEMPLATE [OPTIONS FLAG...]): adds TEMPLATE.cpp.in, configured for every fractal, precision
# and mode, to the target, each with its mode's floating-point flags and then the options. The template sees fractal,
# fractal_file, precision, is_float, mode, is_fast and file.
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
