# SPDX-License-Identifier: Apache-2.0
# Adds backends in which a programming model runs the scalar kernel in its own loops (core/models); see
# docs/add-a-backend.md. The backends cuda and hip are compiled from the sources of backends/cuda.

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
    mandelmarch_kernels(${with_KERNELS} ${with_TEMPLATES}/loops.cpp.in OPTIONS ${with_OPTIONS} ${loops_table})
    mandelmarch_kernels(${with_KERNELS} ${with_TEMPLATES}/peak.cpp.in BY precision
        OPTIONS ${MANDELMARCH_FP_fast} ${with_OPTIONS} ${peak_table})
endfunction()

# mandelmarch_gpu_images(TEMPLATE NAME FLAG...): compiles a template to NAME.cpp.IMAGE for each image of the calling
# mandelmarch_gpu_model(), whose variables it uses.
function(mandelmarch_gpu_images template name)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    configure_file(${folder}/${template} ${file}.cu @ONLY)
    foreach(image ${with_IMAGES})
        set(out ${file}.${image})
        add_custom_command(OUTPUT ${out}
            COMMAND ${with_COMMAND} ${ARGN} ${with_OPTION}${image} -I${PROJECT_SOURCE_DIR} -MD -MF ${out}.d
                ${file}.cu -o ${out}
            DEPENDS ${file}.cu DEPFILE ${out}.d VERBATIM)
        set_property(SOURCE ${file} APPEND PROPERTY OBJECT_DEPENDS ${out})
    endforeach()
endfunction()

# mandelmarch_gpu_model(NAME DRIVER FUNCTION DEVICE FILE CODE TEXT NEEDED TEXT COMPILER WORD... COMMAND WORD...
#     OPTION TEXT IMAGES NAME... EXACT FLAG... FAST FLAG... [DEFINITIONS DEFINITION...]): adds the target
# mandelmarch_NAME. FUNCTION of core/gpu/driver.h returns the driver. FILE exists on a machine that has such a GPU. CODE
# describes the code of the kernels, and NEEDED what can load it. COMMAND with the FLAGs of a mode compiles a source;
# OPTION, followed by the name of an image, makes the command write this image.
function(mandelmarch_gpu_model model)
    cmake_parse_arguments(PARSE_ARGV 1 with "" "DRIVER;DEVICE;CODE;NEEDED;OPTION"
        "COMPILER;COMMAND;IMAGES;EXACT;FAST;DEFINITIONS")
    set(folder ${PROJECT_SOURCE_DIR}/backends/cuda)
    mandelmarch_job_model(${model} ${folder}/cuda.cpp ${folder}/module.cpp TEMPLATES ${folder})
    target_compile_definitions(mandelmarch_${model} PRIVATE MM_MODEL=${model} MM_DRIVER=${with_DRIVER}
        MM_FACTORY=make_${model}_backend MANDELMARCH_GPU_MODEL="${model}" MANDELMARCH_GPU_CODE="${with_CODE}"
        MANDELMARCH_GPU_NEEDED="${with_NEEDED}" ${with_DEFINITIONS})
    # Tests read these properties. A machine without the device file cannot run the backend.
    set_target_properties(mandelmarch_${model} PROPERTIES
        MANDELMARCH_GPU_ONLY ${with_DEVICE} MANDELMARCH_COMMAND "${with_COMMAND};${with_EXACT}")
    mandelmarch_kernel_build(${folder}/cuda.cpp COMPILER ${with_COMPILER} EXACT ${with_EXACT} FAST ${with_FAST})

    foreach(precision float double)
        string(COMPARE EQUAL ${precision} float is_float)
        mandelmarch_gpu_images(peak.cu.in peak_${precision} ${with_FAST})
        foreach(fractal ${MANDELMARCH_FRACTALS})
            set(fractal_file ${MANDELMARCH_TEXT_${fractal}})
            foreach(mode exact fast)
                string(TOUPPER ${mode} flags)
                mandelmarch_gpu_images(kernel.cu.in loops_${fractal}_${precision}_${mode} ${with_${flags}})
            endforeach()
        endforeach()
    endforeach()
endfunction()
