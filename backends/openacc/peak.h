// SPDX-License-Identifier: Apache-2.0
// The multiply-add peak of an OpenACC device.
#pragma once

#include "core/render/backend.h"

namespace mandelmarch::openacc {

// Operations per second, on the device that the calling thread uses.
double multiply_add_peak(const Device& device, Precision precision);

}  // namespace mandelmarch::openacc
