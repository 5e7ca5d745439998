# SPDX-License-Identifier: Apache-2.0
# Settings of g++'s offload compiler for NVIDIA GPUs (nvptx), common to all backends that use this compiler.

# Debian's offload compiler runs a program `as` to assemble. The wrapper made from nvptx_as.in is in a folder that the
# compiler searches first, and calls the real assembler nvptx-none-as.
find_program(nvptx_as nvptx-none-as)
mark_as_advanced(nvptx_as)
# Device code is compiled at link time, with the flags of each source. By default nvptx rounds division and square root
# correctly and keeps subnormal numbers. nvptx_as.in fixes the rounding of add, sub and mul.
set(MANDELMARCH_NVPTX_OPTIONS -fno-math-errno -fno-trapping-math -misa=sm_35)
set(MANDELMARCH_NVPTX_ASSEMBLER ${CMAKE_BINARY_DIR}/nvptx)  # folder
option(MANDELMARCH_NVPTX_APPROXIMATE "In fast mode, openacc and omptarget use the GPU's approximate instructions" ON)
if(nvptx_as)
    configure_file(${CMAKE_CURRENT_LIST_DIR}/nvptx_as.in ${MANDELMARCH_NVPTX_ASSEMBLER}/as @ONLY
        FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endif()
list(JOIN MANDELMARCH_NVPTX_OPTIONS " " MANDELMARCH_NVPTX_LINK)
# Linker flags. Backends append MANDELMARCH_NVPTX_ASSEMBLER to them, as the value of -B.
set(MANDELMARCH_NVPTX_LINK "-foffload-options=nvptx-none=${MANDELMARCH_NVPTX_LINK} -B")
# The fewer registers a kernel uses, the more threads a GPU can hold. Therefore optimisations that keep values in
# registers over a whole loop are disabled: hoisting of invariants, and elimination of redundancies across basic blocks.
# tests/gpu/ptx_test.py limits the registers.
set(MANDELMARCH_NVPTX_FEW_REGISTERS -O2 -fno-gcse -fno-tree-pre -fno-move-loop-invariants -fno-tree-loop-optimize)
if(NOT MANDELMARCH_NVPTX_APPROXIMATE)
    list(APPEND MANDELMARCH_NVPTX_FEW_REGISTERS -DMM_EXACT_WORDS)
endif()

# mandelmarch_loop_compiles(RESULT DIRECTIVE): sets RESULT to whether the compiler can compile a loop under the pragma
# DIRECTIVE, with the caller's CMAKE_REQUIRED_FLAGS and CMAKE_REQUIRED_LINK_OPTIONS.
function(mandelmarch_loop_compiles result directive)
    include(CheckCXXSourceCompiles)
    check_cxx_source_compiles("
        int main(int count, char**)
        {
            float sums[64];
        #pragma ${directive}
            for (int i = 0; i < 64; ++i) sums[i] = float(i) * float(count) + 1;
            return sums[63] > 0 ? 0 : 1;
        }" ${result})
    set(${result} ${${result}} PARENT_SCOPE)
endfunction()

# mandelmarch_offloads(BACKEND FLAG DIRECTIVE): sets MANDELMARCH_BACKEND_OFFLOADS to whether g++ with FLAG can compile a
# loop under the pragma DIRECTIVE for nvptx. If it cannot, prints the reason.
function(mandelmarch_offloads backend flag directive)
    string(TOUPPER MANDELMARCH_${backend}_OFFLOADS result)
    set(${result} FALSE PARENT_SCOPE)
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        message(STATUS "${backend}: this build does not use g++")
        return()
    endif()
    if(NOT nvptx_as)
        message(STATUS "${backend}: g++ has no offload compiler for nvptx (Debian: gcc-offload-nvptx)")
        return()
    endif()
    if(CMAKE_BINARY_DIR MATCHES " ")
        # g++ splits the offload compiler's options at blanks.
        message(STATUS "${backend}: '${CMAKE_BINARY_DIR}' contains a blank, expected a build folder without one")
        return()
    endif()
    set(CMAKE_REQUIRED_FLAGS "${flag} -foffload=nvptx-none -fno-pie")
    set(CMAKE_REQUIRED_LINK_OPTIONS ${flag} -foffload=nvptx-none -no-pie
        "${MANDELMARCH_NVPTX_LINK}${MANDELMARCH_NVPTX_ASSEMBLER}/")
    mandelmarch_loop_compiles(${result} "${directive}")
    if(NOT ${result})
        message(STATUS "${backend}: g++ cannot compile '#pragma ${directive}' for nvptx")
    endif()
    set(${result} ${${result}} PARENT_SCOPE)
endfunction()
