# SPDX-License-Identifier: Apache-2.0
# The floating-point policy, in flags of C++. docs/floating-point.md explains it.
#   exact  IEEE operations one by one: no contraction to fused multiply-add, no reassociation.
#   fast   contraction allowed; still no reassociation and no flush to zero.
# Neither changes the process: no -ffast-math anywhere, whose start-up code would turn on flush-to-zero for all threads.
set(MANDELMARCH_FP_COMMON -fno-math-errno -fno-trapping-math)
set(MANDELMARCH_FP_exact ${MANDELMARCH_FP_COMMON} -ffp-contract=off)
set(MANDELMARCH_FP_fast ${MANDELMARCH_FP_COMMON} -ffp-contract=fast)
# Host code that prepares scenes or draws the reference must not depend on the compiler's mood either.
add_compile_options(-ffp-contract=off)
