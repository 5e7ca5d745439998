# SPDX-License-Identifier: Apache-2.0
# The wide tests. They link each library alone, build the project with other presets, bundle it, run GPU kernels on a
# simulated GPU, or call NVIDIA's assembler.
include(builds/libraries.cmake)
mandelmarch_cases(builds builds/builds_test.sh WIDE subproject package blank excess_precision
    ARGUMENTS ${source} ${PROJECT_BINARY_DIR})
# Two programs whose list of backends has an additional line, which registers the skeleton.
mandelmarch_registry(mandelmarch_backends_and_skeleton ${MANDELMARCH_REGISTERED} skeleton)
add_executable(render_with_skeleton ${PROJECT_SOURCE_DIR}/apps/render.cpp ${PROJECT_BINARY_DIR}/apps/render_main.cpp)
target_link_libraries(render_with_skeleton PRIVATE mandelmarch_apps mandelmarch_backends_and_skeleton mandelmarch_warnings)
add_executable(bench_with_skeleton ${PROJECT_SOURCE_DIR}/bench/main.cpp ${PROJECT_BINARY_DIR}/bench/bench_main.cpp)
target_link_libraries(bench_with_skeleton PRIVATE mandelmarch_bench mandelmarch_backends_and_skeleton mandelmarch_warnings)
mandelmarch_cases(registration models/registration_test.sh WIDE lists pictures bench ARGUMENTS ${bin} ${source} ${Python3_EXECUTABLE})
find_program(MANDELMARCH_PATCHELF patchelf)
if(MANDELMARCH_PATCHELF OR DEFINED ENV{CI})
    mandelmarch_cases(packaging packaging/bundle_test.sh WIDE bundle ARGUMENTS ${PROJECT_BINARY_DIR} ${source})
    set_tests_properties(packaging.bundle PROPERTIES RESOURCE_LOCK build)
endif()
# Adds tests that run kernels on a simulated GPU. The test `driver` builds the GPU's driver for the other tests.
set(simulated bits clock trial bands little_memory devices failures locks resident_warps)
foreach(backend openacc cuda hip)
    if(TARGET mandelmarch_${backend})
        set(gpu ${CMAKE_CURRENT_BINARY_DIR}/simulated_gpu/${backend})
        mandelmarch_cases(${backend}.simulated gpu/simulated_test.sh WIDE driver ${simulated}
            ARGUMENTS ${bin} ${source} ${gpu} ${CMAKE_CXX_COMPILER} ${Python3_EXECUTABLE})
        set_tests_properties(${backend}.simulated.driver PROPERTIES FIXTURES_SETUP ${backend}_gpu)
        list(TRANSFORM simulated PREPEND ${backend}.simulated. OUTPUT_VARIABLE tests)
        set_tests_properties(${tests} PROPERTIES FIXTURES_REQUIRED ${backend}_gpu)
    endif()
endforeach()
if(TARGET mandelmarch_openacc)
    foreach(check text assemble)
        mandelmarch_script(openacc.ptx.${check} gpu/ptx_test.py WIDE
            ARGUMENTS ${check} $<TARGET_FILE:mandelbulb> ${MANDELMARCH_FRACTALS})
        set_tests_properties(openacc.ptx.${check} PROPERTIES WORKING_DIRECTORY ${source})
    endforeach()
endif()
if(TARGET mandelmarch_hip)
    get_target_property(command mandelmarch_hip MANDELMARCH_COMMAND)
    mandelmarch_script(hip.text gpu/hip_test.py WIDE ARGUMENTS ${PROJECT_BINARY_DIR}/backends/hip ${command} -I${source})
endif()
if(TARGET mandelmarch_cuda AND TARGET mandelmarch_openacc AND TARGET mandelmarch_opencl AND TARGET mandelmarch_vulkan)
    mandelmarch_cases(packaging packaging/gpu_check_test.sh WIDE gpu_check
        ARGUMENTS ${bin} ${source} ${CMAKE_CURRENT_BINARY_DIR}/simulated_gpu/cuda ${Python3_EXECUTABLE})
    set_tests_properties(packaging.gpu_check PROPERTIES FIXTURES_REQUIRED cuda_gpu)
endif()

# mandelmarch_sibling(PRESET COST TARGET...): adds a test that builds the targets with another preset. Builds with a
# higher COST start first.
function(mandelmarch_sibling preset cost)
    mandelmarch_test(build.${preset} WIDE COMMAND ${source}/tools/build ${preset} ${ARGN})
    set_tests_properties(build.${preset} PROPERTIES FIXTURES_SETUP ${preset} RESOURCE_LOCK build TIMEOUT 2400 COST ${cost}
        WORKING_DIRECTORY ${source})
endfunction()
# Adds four builds: with clang, the program whose pictures are compared with this build's; with each of two sanitizers,
# the programs to test; and the programs and tests for every fractal, with tests/fractals/sierpinski as the only
# fractal.
set(micro "")
if(TARGET bench_micro)
    set(micro bench_micro)
endif()
mandelmarch_sibling(clang 1 render)
mandelmarch_sibling(asan 4 unit_test same_bits_test fuzz render imgdiff mandelbulb mandelbox)
mandelmarch_sibling(tsan 2 same_bits_test data_race)
mandelmarch_sibling(fractal 3 bench ${micro} render flythrough imgdiff every_fractal_test equivalence_test)
set_tests_properties(build.clang PROPERTIES ENVIRONMENT "SPIRV=${PROJECT_BINARY_DIR}/backends/vulkan")
mandelmarch_script(same_bits.compilers builds/same_bits.sh WIDE ARGUMENTS ${bin} ${source}/build/clang/bin)
set_tests_properties(same_bits.compilers PROPERTIES FIXTURES_REQUIRED clang WORKING_DIRECTORY ${source})
mandelmarch_cases(omptarget.clang models/omptarget_test.sh WIDE bits plugin
    ARGUMENTS ${bin} ${source} ${source}/build/clang/bin)
set_tests_properties(omptarget.clang.bits omptarget.clang.plugin PROPERTIES FIXTURES_REQUIRED clang)
# Other processors, emulated. CI must have the tools.
find_program(MANDELMARCH_MMDEBSTRAP mmdebstrap)
foreach(pair arm64:aarch64 riscv64:riscv64 s390x:s390x)
    string(REPLACE ":" ";" pair ${pair})
    list(GET pair 0 arch)
    list(GET pair 1 name)
    find_program(MANDELMARCH_CXX_${arch} ${name}-linux-gnu-g++)
    find_program(MANDELMARCH_EMULATOR_${arch} qemu-${name}-static)
    mark_as_advanced(MANDELMARCH_CXX_${arch} MANDELMARCH_EMULATOR_${arch})
    if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND (DEFINED ENV{CI} OR
            (MANDELMARCH_MMDEBSTRAP AND MANDELMARCH_CXX_${arch} AND MANDELMARCH_EMULATOR_${arch})))
        mandelmarch_script(same_bits.${arch} builds/cross.sh WIDE ARGUMENTS ${bin} ${arch})
        set_tests_properties(same_bits.${arch} PROPERTIES RESOURCE_LOCK build TIMEOUT 2400 WORKING_DIRECTORY ${source})
    endif()
endforeach()
foreach(preset asan tsan)
    mandelmarch_test(suite.${preset} WIDE COMMAND ${CMAKE_CTEST_COMMAND} --preset ${preset})
    set_tests_properties(suite.${preset} PROPERTIES FIXTURES_REQUIRED ${preset} TIMEOUT 2400 WORKING_DIRECTORY ${source})
endforeach()
set_tests_properties(suite.asan PROPERTIES COST 4)
foreach(name every_fractal_test equivalence_test)
    mandelmarch_test(suite.fractal.${name} WIDE COMMAND ${source}/build/fractal/bin/${name})
endforeach()
set(programs render equivalence bench bench_random viewer flythrough)
mandelmarch_cases(suite.fractal fractals/programs_test.sh WIDE ${programs}
    ARGUMENTS ${source}/build/fractal/bin ${CMAKE_CURRENT_SOURCE_DIR}/fractals)
list(TRANSFORM programs PREPEND suite.fractal.)
set_tests_properties(suite.fractal.every_fractal_test suite.fractal.equivalence_test ${programs} PROPERTIES
    FIXTURES_REQUIRED fractal)
