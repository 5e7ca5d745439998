# SPDX-License-Identifier: Apache-2.0
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
