// SPDX-License-Identifier: Apache-2.0
// Camera factors of all columns and rows, for kernels without registers to compute them.
#pragma once

#include <vector>

#include "core/render/kernel_scene.h"

namespace mandelmarch::job {

// Factors of along_axes() in core/kernel/camera.h: a.re of all columns, a.im of all columns, then b of the rows
// likewise. In exact mode the bits equal those of the kernel.
std::vector<float> camera_table(const layout_f32::Scene& scene);
std::vector<double> camera_table(const layout_f64::Scene& scene);

}  // namespace mandelmarch::job
