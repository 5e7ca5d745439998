// SPDX-License-Identifier: Apache-2.0
// Converts a scene to the kernel's parameters, in each precision.
#pragma once

#include <type_traits>

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// The structs of core/kernel/scene.h in double and in float. Backends pass them to their devices as bytes.
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

// The kernel's Scene for a floating-point type.
template <class Real>
using KernelScene = std::conditional_t<std::is_same_v<Real, float>, layout_f32::Scene, layout_f64::Scene>;

// Returns a scene as another type with the same layout: the struct Scene of a namespace that includes the kernel
// source.
template <class Scene, class Layout>
const Scene& scene_as(const Layout& scene)
{
    static_assert(sizeof(Scene) == sizeof(Layout) && alignof(Scene) == alignof(Layout));
    return reinterpret_cast<const Scene&>(scene);
}

// Values of the original program.
inline constexpr int max_steps = 8000;           // max number of samples of a ray
inline constexpr double farthest_sample = 1000;  // max t of a sample

// Returns the kernel's parameters. They are computed in double and then rounded. In exact mode a hit is the last sample
// of the original stepping, in fast mode the canonical hit. If the scene is smooth, normals come from differences over
// a tetrahedron. If not, normals in double come from central differences in exact mode and without the technique
// `gradient`. All other normals come from the analytic gradient, but in conservative scenes, whose estimate has no such
// gradient, from differences over a tetrahedron. Throws InputError for float without the technique `gradient`.
template <class Layout>
Layout kernel_scene(const Scene& scene, Mode mode, const Techniques& techniques = {});

// The camera's axes. `forward` is the unit vector of the view direction. `across` and `upward` point from the picture's
// centre to its right and top edge, at distance 1. If the scene has a crop window, these are the axes of the whole
// picture.
struct Camera {
    Vector forward, across, upward;
};

Camera camera_of(const Scene& scene);

}  // namespace mandelmarch
