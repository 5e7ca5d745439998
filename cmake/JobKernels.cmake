# SPDX-License-Identifier: Apache-2.0
# Backends whose kernels are the scalar kernel in a model's loops (core/job); see docs/add-a-backend.md.
include(KernelVariants)

# mandelmarch_job_model(NAME SOURCE... [KERNELS TARGET] [TEMPLATES FOLDER] [OPTIONS FLAG...] [PACKAGES TARGET...]): adds
# the target mandelmarch_NAME with its sources, core/job's table of kernels, and the kernels: loops.cpp.in for every
# fractal, precision and mode, and peak.cpp.in with fast mode's contraction. These two templates come from core/job,
# where they call loop() of backends/NAME/loop.h, or from FOLDER. The kernels become part of TARGET, if given. FLAGs
# apply to the kernels alone; PACKAGES are linked to mandelmarch_NAME.
function(mandelmarch_job_model model)
    cmake_parse_arguments(PARSE_ARGV 1 with "" "KERNELS;TEMPLATES" "OPTIONS;PACKAGES")
    set(target mandelmarch_${model})
    add_library(${target} STATIC ${with_UNPARSED_ARGUMENTS})
    target_link_libraries(${target} PUBLIC mandelmarch_core PRIVATE ${with_PACKAGES} mandelmarch_warnings fmt::fmt)
    target_include_directories(${target} PRIVATE ${MANDELMARCH_FRACTAL_LIST_FOLDER})
    configure_file(${PROJECT_SOURCE_DIR}/core/job/kernels.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/kernels.cpp @ONLY)
    target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/kernels.cpp)
    if(NOT with_KERNELS)
        set(with_KERNELS ${target})
    endif()
    if(NOT with_TEMPLATES)
        set(with_TEMPLATES ${PROJECT_SOURCE_DIR}/core/job)
    endif()
    # For tests that build the kernels again from a mutant of the kernel source.
    set_target_properties(${target} PROPERTIES
        MANDELMARCH_TEMPLATES "${with_TEMPLATES}" MANDELMARCH_OPTIONS "${with_OPTIONS}")
    mandelmarch_kernel_variants(${with_KERNELS} ${with_TEMPLATES}/loops OPTIONS ${with_OPTIONS})
    foreach(precision float double)
        string(COMPARE EQUAL ${precision} float is_float)
        set(file ${CMAKE_CURRENT_BINARY_DIR}/peak_${precision}.cpp)
        configure_file(${with_TEMPLATES}/peak.cpp.in ${file} @ONLY)
        target_sources(${with_KERNELS} PRIVATE ${file})
        set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS "${MANDELMARCH_FP_fast};${with_OPTIONS}")
    endforeach()
endfunction()
