// SPDX-License-Identifier: Apache-2.0
// What columns and rows do to the camera's axes, for kernels that have no registers to compute it in.
#pragma once

#include <vector>

#include "core/render/kernel_scene.h"

namespace mandelmarch::job {

// Of core/kernel/camera.h's along_axes(): a.re of all columns, a.im of all columns, then the same of the rows' b, with
// the bits of the text in exact mode.
std::vector<float> camera_table(const layout_f32::Scene& scene);
std::vector<double> camera_table(const layout_f64::Scene& scene);

}  // namespace mandelmarch::job
