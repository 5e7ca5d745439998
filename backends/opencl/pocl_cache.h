// SPDX-License-Identifier: Apache-2.0
// PoCL, the OpenCL driver for CPUs, keeps what it has compiled in a folder, without which it does not work.
#pragma once

namespace mandelmarch::opencl {

// Names a folder of the user's in the temporary folder to PoCL, by POCL_CACHE_DIR, where its usual one cannot be
// written: without a home, say. To be called before the first call of OpenCL.
void provide_pocl_cache();

}  // namespace mandelmarch::opencl
