# SPDX-License-Identifier: Apache-2.0
# mandelmarch_instruction_sets(TARGET): sets the instruction sets for which Highway compiles the packs (SIMD vectors of
# pixels) of a target.
set(MANDELMARCH_INSTRUCTIONS all CACHE STRING
    "Instruction sets of the packs on x86: all (SSE4, AVX2 and AVX-512; the machine's best is taken at run time), or native")
set_property(CACHE MANDELMARCH_INSTRUCTIONS PROPERTY STRINGS all native)

if(NOT MANDELMARCH_INSTRUCTIONS MATCHES "^(all|native)$")
    message(FATAL_ERROR "MANDELMARCH_INSTRUCTIONS: '${MANDELMARCH_INSTRUCTIONS}' given, expected all or native")
endif()
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64|i.86)$")
    # Elsewhere packs are compiled for the compiler's own target: NEON on ARM. Vectors whose size is unknown at compile
    # time (SVE, RISC-V's) cannot be elements of the packs' arrays.
    set(disabled "HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV")
elseif(MANDELMARCH_SANITIZER)
    # Sanitizers check the code around the kernel. It is the same for all instruction sets and pack widths, so one
    # instruction set and one pack width suffice.
    set(instruction_sets HWY_AVX2)
elseif(MANDELMARCH_INSTRUCTIONS STREQUAL "native")
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/instruction_set.cpp @ONLY CONTENT [[
#include <cstdio>
int main()
{
    const bool avx3 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
    std::fputs(avx3 ? "HWY_AVX3" : avx2 ? "HWY_AVX2" : "HWY_SSE4", stdout);
}
]])
    try_run(ran compiled ${PROJECT_BINARY_DIR}/instruction_set SOURCES ${PROJECT_BINARY_DIR}/instruction_set.cpp
        RUN_OUTPUT_VARIABLE instruction_sets)
    if(NOT compiled OR NOT ran EQUAL 0)
        message(FATAL_ERROR "MANDELMARCH_INSTRUCTIONS=native: the instruction set of this machine is unknown, expected all")
    endif()
else()
    set(instruction_sets "HWY_SSE4|HWY_AVX2|HWY_AVX3")
endif()

# Highway has a bit for every instruction set. The lowest fourteen bits belong to the x86 instruction sets beyond SSE2.
# All of these sets are disabled, except the selected ones.
if(NOT disabled)
    set(disabled "0x3fffLL&~(${instruction_sets})")
endif()
function(mandelmarch_instruction_sets target)
    target_compile_definitions(${target} PRIVATE "HWY_DISABLED_TARGETS=(${disabled})")
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm)")
        # Disables Highway's choice at run time. With it, g++ compiles the packs' functions for another target than
        # their constructors, and cannot inline these.
        target_compile_definitions(${target} PRIVATE TOOLCHAIN_MISS_SYS_AUXV_H)
    endif()
    if(MANDELMARCH_SANITIZER)
        target_compile_definitions(${target} PRIVATE MANDELMARCH_ONE_WIDTH)
    endif()
endfunction()
