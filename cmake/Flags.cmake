# SPDX-License-Identifier: Apache-2.0
# Compiler flags of all targets: warnings, the floating-point policy, sanitizers.

add_library(mandelmarch_warnings INTERFACE)
target_compile_options(mandelmarch_warnings INTERFACE -Wall -Wextra -Wpedantic -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-align -Wunused
    # Left out in unity builds, in which a source can shadow the private names of the sources before it.
    $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow>
    # The kernel passes its scene by value, but all such calls are inlined, so the ABI does not matter.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>
    # Clang warns of Highway's per-target regions that contain only templates.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-pragma-clang-attribute>)
if(MANDELMARCH_WERROR)
    target_compile_options(mandelmarch_warnings INTERFACE -Werror)
endif()

# Floating-point policy as C++ flags (docs/floating-point.md).
#   exact  each IEEE operation is rounded separately: no contraction to fused multiply-add, no reassociation.
#   fast   contraction is allowed; no reassociation, no flush to zero.
# -ffast-math is not used anywhere, because its start-up code would enable flush-to-zero in all threads of the process.
set(MANDELMARCH_FP_COMMON -fno-math-errno -fno-trapping-math)
set(MANDELMARCH_FP_exact ${MANDELMARCH_FP_COMMON} -ffp-contract=off)
set(MANDELMARCH_FP_fast ${MANDELMARCH_FP_COMMON} -ffp-contract=fast)
# Host code also prepares scenes and renders the reference. Its results must not depend on the compiler either.
add_compile_options(-ffp-contract=off)
# 32-bit x86 computes in registers of 80 bits by default, which rounds twice.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64|i.86)$" AND CMAKE_SIZEOF_VOID_P EQUAL 4)
    add_compile_options(-msse2 -mfpmath=sse)
endif()

# MANDELMARCH_SANITIZER=address|thread, for all targets.
if(MANDELMARCH_SANITIZER STREQUAL "address")
    add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
    # In packs, only accesses outside the stack are checked, by calls instead of inline code. With more checks, clang
    # takes minutes for a source of intrinsics. The scalar sources contain the same kernel with all checks.
    set(MANDELMARCH_SANITIZER_packs -fno-sanitize=undefined -mllvm -asan-stack=0
        -mllvm -asan-instrumentation-with-call-threshold=0)
    # If estimators are called instead of inlined, the scalar sources build in a fifth of the time.
    set(MANDELMARCH_SANITIZER_scalar -DFN_CALLED=inline)
elseif(MANDELMARCH_SANITIZER STREQUAL "thread")
    add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
    add_link_options(-fsanitize=thread)
    # The kernel needs no checks: in it, threads share only the scene, which is constant.
    set(MANDELMARCH_SANITIZER_packs -fno-sanitize=thread)
    set(MANDELMARCH_SANITIZER_scalar -fno-sanitize=thread)
    set(MANDELMARCH_SANITIZER_ray -fno-sanitize=thread)
elseif(MANDELMARCH_SANITIZER)
    message(FATAL_ERROR "MANDELMARCH_SANITIZER is '${MANDELMARCH_SANITIZER}', expected address or thread")
endif()
