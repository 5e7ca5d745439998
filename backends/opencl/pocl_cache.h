// SPDX-License-Identifier: Apache-2.0
// The folder in which PoCL, the OpenCL driver for CPUs, caches compiled kernels; PoCL requires it.
#pragma once

namespace mandelmarch::opencl {

// If the default folder is not writable (without a home, for example), sets POCL_CACHE_DIR to a per-user folder in the
// temporary folder. Call it before the first call of OpenCL.
void provide_pocl_cache();

}  // namespace mandelmarch::opencl
