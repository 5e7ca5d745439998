// SPDX-License-Identifier: Apache-2.0
// Camera factors of all columns and rows of a picture, for kernels that have too few registers to compute them.
#pragma once

#include <vector>

#include "core/render/kernel_scene.h"

namespace mandelmarch::job {

// Returns the factors a and b of along_axes() in core/kernel/camera.h: the real parts of a for all columns, then their
// imaginary parts, then b for all rows in the same way. In exact mode the factors equal those that a kernel computes,
// bit for bit.
std::vector<float> camera_table(const layout_f32::Scene& scene);
std::vector<double> camera_table(const layout_f64::Scene& scene);

}  // namespace mandelmarch::job
