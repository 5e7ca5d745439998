// How far apart the rays of a picture are: how wide its cones, and how far around the hull its blocks ask.
#pragma once

#include <cmath>

#include "backends/openmp/ray_pool.h"
#include "core/scene/fractal.h"

namespace mandelmarch::openmp {

// The length of a triple of the kernel's scene.
template <class Triple>
auto length_of(const Triple& a) -> decltype(a.x + 0)
{
    return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

// How far apart at distance 1 the rays of two diagonal neighbours are, at most.
template <class KernelScene>
auto spacing_of(const KernelScene& scene) -> decltype(scene.tolerance + 0)
{
    using Real = decltype(scene.tolerance + 0);
    return 2 * std::hypot(length_of(scene.across) / static_cast<Real>(scene.width),
                          length_of(scene.upward) / static_cast<Real>(scene.height));
}

// The same where cones pay, else 0. A cone ends some of its widths before the surface; where a pixel is many tolerances
// wide, that can be at once.
template <class KernelScene>
auto pitch_of(const KernelScene& scene, const Fractal& fractal) -> decltype(scene.tolerance + 0)
{
    const auto pitch = spacing_of(scene);
    return pitch < fractal.cone_pitch * scene.tolerance ? pitch : 0;
}

// The size of a hull in which the ray through a block's middle is wherever one of the block's rays is in the scene's
// hull; 0 where that has none. A ray is in the scene's hull at distance `farthest` at most, and there half a block's
// diagonal away from the middle one.
template <class KernelScene>
auto block_hull_of(const KernelScene& scene, const Fractal& fractal) -> decltype(scene.tolerance + 0)
{
    using Real = decltype(scene.tolerance + 0);
    if (!(scene.hull > 0)) return 0;
    const Real farthest = length_of(scene.eye) + static_cast<Real>(fractal.hull_corner) * scene.hull;
    const Real rounding = Real(1.001);
    return rounding * (scene.hull + spacing_of(scene) * Real(block_side) / 2 * farthest);
}

}  // namespace mandelmarch::openmp
