// SPDX-License-Identifier: Apache-2.0
// A scene as the kernel text takes it, in each precision.
#pragma once

#include <type_traits>

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// The layouts come from the text itself (core/kernel/scene.h); a backend passes them on as bytes.
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

// float's layout or double's.
template <class Real>
using KernelScene = std::conditional_t<std::is_same_v<Real, float>, layout_f32::Scene, layout_f64::Scene>;

// Of the original program.
inline constexpr int max_steps = 8000;           // samples on a ray
inline constexpr double farthest_sample = 1000;  // the largest t of a sample

// Computed in double, then rounded.
// exact: the plain schedule's hit. fast: the canonical hit.
// The normal comes from central differences in double and from the analytic gradient in float.
template <class Layout>
Layout kernel_scene(const Scene& scene, Mode mode, const Techniques& techniques = {});

// The camera's axes: forward is the unit vector of the view; across and upward lead from the picture's middle to its
// right and top edges at distance 1. Of the whole picture where the scene is a part of one.
struct Camera {
    Vector forward, across, upward;
};

Camera camera_of(const Scene& scene);

}  // namespace mandelmarch
