# SPDX-License-Identifier: Apache-2.0
# Adds backends in which a programming model runs the scalar kernel in its own loops (core/models); see
# docs/add-a-backend.md.
include(Kernels)

# mandelmarch_host_model(NAME [OPTIONS FLAG...] [PACKAGES PACKAGE...] [COMPILER WORD...]): adds the target
# mandelmarch_NAME, a backend whose loop on this machine's cores is in backends/NAME/loop.h (core/models/host.h). The
# FLAGs apply to the kernels alone. The PACKAGEs are linked. The WORDs are recorded as the compiler.
function(mandelmarch_host_model model)
    cmake_parse_arguments(PARSE_ARGV 1 with "" "" "OPTIONS;PACKAGES;COMPILER")
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${model}.cpp)
    configure_file(${PROJECT_SOURCE_DIR}/core/models/host.cpp.in ${source} @ONLY)
    mandelmarch_job_model(${model} ${source} OPTIONS ${with_OPTIONS} PACKAGES ${with_PACKAGES})
    mandelmarch_kernel_build(${source} COMPILER ${with_COMPILER}
        EXACT ${MANDELMARCH_CXX_FLAGS} ${with_OPTIONS} ${MANDELMARCH_FP_exact}
        FAST ${MANDELMARCH_CXX_FLAGS} ${with_OPTIONS} ${MANDELMARCH_FP_fast})
endfunction()

# mandelmarch_job_model(NAME SOURCE... [KERNELS TARGET] [TEMPLATES FOLDER] [OPTIONS FLAG...] [PACKAGES PACKAGE...]):
# adds the target mandelmarch_NAME with the SOURCEs and the kernels. The kernels are generated from two templates:
# loops.cpp.in for every fractal, precision and mode, and peak.cpp.in for every precision, with fast mode's contraction.
# The templates are in FOLDER. By default they are those of core/models, which call Loop::run() of backends/NAME/loop.h. The
# functions drawing() and chains() (core/models/model.h) find the kernels; they are generated in the namespace
# mandelmarch::NAME. If TARGET is given, the kernels become part of TARGET instead, and the SOURCEs must define both
# functions. The FLAGs apply to the kernels alone. The PACKAGEs are linked to mandelmarch_NAME.
function(mandelmarch_job_model model)
    cmake_parse_arguments(PARSE_ARGV 1 with "" "KERNELS;TEMPLATES" "OPTIONS;PACKAGES")
    set(target mandelmarch_${model})
    add_library(${target} STATIC ${with_UNPARSED_ARGUMENTS})
    target_link_libraries(${target} PUBLIC mandelmarch_core PRIVATE ${with_PACKAGES} mandelmarch_warnings fmt::fmt)
    set(types HEADER core/models/model.h NAMESPACE mandelmarch::${model})
    set(loops_table TABLE drawing CODE job::DrawKernel ${types})
    set(peak_table TABLE chains CODE job::Chains ${types})
    if(with_KERNELS)
        set(loops_table "")
        set(peak_table "")
    else()
        set(with_KERNELS ${target})
    endif()
    if(NOT with_TEMPLATES)
        set(with_TEMPLATES ${PROJECT_SOURCE_DIR}/core/models)
    endif()
    # Tests read these properties to build the kernels again from a mutant of the kernel source.
    set_target_properties(${target} PROPERTIES
        MANDELMARCH_TEMPLATES "${with_TEMPLATES}" MANDELMARCH_OPTIONS "${with_OPTIONS}")
    mandelmarch_kernels(${with_KERNELS} ${with_TEMPLATES}/loops.cpp.in OPTIONS ${with_OPTIONS} ${loops_table})
    mandelmarch_kernels(${with_KERNELS} ${with_TEMPLATES}/peak.cpp.in BY precision
        OPTIONS ${MANDELMARCH_FP_fast} ${with_OPTIONS} ${peak_table})
endfunction()
