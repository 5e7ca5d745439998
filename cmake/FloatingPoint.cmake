# SPDX-License-Identifier: Apache-2.0
# Floating-point policy as C++ flags (docs/floating-point.md).
#   exact  each IEEE operation is rounded by itself: no contraction to fused multiply-add, no reassociation.
#   fast   contraction allowed; no reassociation, no flush to zero.
# -ffast-math is not used anywhere: its start-up code would enable flush-to-zero in all threads of the process.
set(MANDELMARCH_FP_COMMON -fno-math-errno -fno-trapping-math)
set(MANDELMARCH_FP_exact ${MANDELMARCH_FP_COMMON} -ffp-contract=off)
set(MANDELMARCH_FP_fast ${MANDELMARCH_FP_COMMON} -ffp-contract=fast)
# The results of host code that prepares scenes or renders the reference must not depend on the compiler either.
add_compile_options(-ffp-contract=off)
