# SPDX-License-Identifier: Apache-2.0
# The floating-point policy, for every backend. docs/floating-point.md explains it.
#   exact  IEEE operations one by one: no contraction to fused multiply-add, no reassociation.
#   fast   contraction allowed; still no reassociation and no flush to zero.
# Neither changes the process: no -ffast-math anywhere, whose start-up code would turn on flush-to-zero for all threads.
set(MANDELMARCH_FP_COMMON -fno-math-errno -fno-trapping-math)
set(MANDELMARCH_FP_exact ${MANDELMARCH_FP_COMMON} -ffp-contract=off)
set(MANDELMARCH_FP_fast ${MANDELMARCH_FP_COMMON} -ffp-contract=fast)
# OpenACC's device code keeps each source's flags through the link, where it is compiled. Correctly rounded division and
# square root, and subnormal numbers, are nvptx's defaults; backends/openacc/as.in pins the rounding of add, sub and mul.
set(MANDELMARCH_FP_nvptx -fno-math-errno -fno-trapping-math)
# Host code that prepares scenes or draws the reference must not depend on the compiler's mood either.
add_compile_options(-ffp-contract=off)

# OpenCL C, compiled at run time. MM_EXACT turns contraction off in the text (core/kernel/prelude/opencl.h); the option for
# division is given where the device has it, else floats are divided in double.
set(MANDELMARCH_OPENCL_exact "-DMM_EXACT=1")
set(MANDELMARCH_OPENCL_fast "-DMM_EXACT=0 -cl-mad-enable")
set(MANDELMARCH_OPENCL_division "-cl-fp32-correctly-rounded-divide-sqrt")
