// SPDX-License-Identifier: Apache-2.0
// Converts a scene to the kernel's parameters, in each precision.
#pragma once

#include <type_traits>

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// The layouts are those of core/kernel/scene.h; backends pass them on as bytes.
namespace layout_f64 {
#define MM_REAL double
#define MM_REAL_IS_FLOAT 0
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/scene.h"
#include "core/kernel/prelude/undefine.h"
#undef MM_REAL
#undef MM_REAL_IS_FLOAT
}  // namespace layout_f64
namespace layout_f32 {
#define MM_REAL float
#define MM_REAL_IS_FLOAT 1
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/scene.h"
#include "core/kernel/prelude/undefine.h"
#undef MM_REAL
#undef MM_REAL_IS_FLOAT
}  // namespace layout_f32

// The layout for a floating-point type.
template <class Real>
using KernelScene = std::conditional_t<std::is_same_v<Real, float>, layout_f32::Scene, layout_f64::Scene>;

// Values of the original program.
inline constexpr int max_steps = 8000;           // max samples of a ray
inline constexpr double farthest_sample = 1000;  // max t of a sample

// Computes in double, then rounds.
// exact: the hit of the original stepping. fast: the canonical hit.
// Normals come from central differences in double and from the analytic gradient in float.
template <class Layout>
Layout kernel_scene(const Scene& scene, Mode mode, const Techniques& techniques = {});

// The camera's axes. forward: unit vector of the view; across and upward: from the picture's centre to its right and
// top edges, at distance 1. With a crop window, those of the whole picture.
struct Camera {
    Vector forward, across, upward;
};

Camera camera_of(const Scene& scene);

}  // namespace mandelmarch
