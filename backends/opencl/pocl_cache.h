// SPDX-License-Identifier: Apache-2.0
// The folder in which PoCL, the OpenCL driver for CPUs, stores compiled kernels. PoCL does not work without one.
#pragma once

namespace mandelmarch::opencl {

// If the default folder is not writable (for example, because the user has no home), sets POCL_CACHE_DIR to a per-user
// folder in the temporary folder. Must be called before the first call of OpenCL.
void provide_pocl_cache();

}  // namespace mandelmarch::opencl
