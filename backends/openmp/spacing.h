// SPDX-License-Identifier: Apache-2.0
// How far apart the rays of a picture are, and what follows: whether blocks begin with cones, how far around the hull
// they ask, and in which lattices pixels are drawn.
#pragma once

#include <cmath>

#include "backends/openmp/neighbours.h"
#include "backends/openmp/ray_pool.h"
#include "core/render/backend.h"
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

// The lattices in which a picture is drawn: the coarsest is one whose hits tell enough of what is between them.
template <class KernelScene>
Lattices lattices_of(const KernelScene& scene, const Fractal& fractal, const Techniques& techniques)
{
    if (scene.canonical == 0 || !techniques.neighbours) return all_at_once;
    int apart = 4;
    while (apart > 1 && apart * spacing_of(scene) > fractal.fast.neighbour_pitch * scene.tolerance) apart /= 2;
    Lattices lattices{{{0, apart}}, 1};
    for (; apart > 1; apart /= 2) lattices.of[lattices.count++] = {apart, apart / 2};
    return lattices;
}

// Whether pixels take over a look's surroundings from pixels beside them: where nothing smaller than a tolerance is to
// be seen, and pixels lie closer than the nearest of the distances at which openness is asked for
// (core/kernel/looks.h).
template <class KernelScene>
bool shares_surroundings(const Scene& scene, const KernelScene& kernel, const Techniques& techniques)
{
    constexpr double nearest_openness = 0.004;  // of the distance from the camera
    return techniques.surroundings && scene.smooth && scene.colouring > 1 && spacing_of(kernel) < nearest_openness;
}

// Whether blocks begin with cones. A cone ends some of its widths before the surface; where a pixel is many tolerances
// wide, that can be at once.
template <class KernelScene>
bool cones_pay(const KernelScene& scene, const Fractal& fractal, const Techniques& techniques)
{
    return scene.canonical != 0 && techniques.cones && spacing_of(scene) < fractal.fast.cone_pitch * scene.tolerance;
}

// The size of a hull in which the ray through a block's middle is wherever one of the block's rays is in the scene's
// hull; 0 where that has none. A ray is in the scene's hull at distance `farthest` at most, and there half a block's
// diagonal away from the middle one.
template <class KernelScene>
auto block_hull_of(const KernelScene& scene, const Fractal& fractal) -> decltype(scene.tolerance + 0)
{
    using Real = decltype(scene.tolerance + 0);
    if (!(scene.hull > 0)) return 0;
    const Real farthest = length_of(scene.eye) + static_cast<Real>(fractal.hull.corner) * scene.hull;
    const Real rounding = Real(1.001);
    return rounding * (scene.hull + spacing_of(scene) * Real(block_side) / 2 * farthest);
}

}  // namespace mandelmarch::openmp
