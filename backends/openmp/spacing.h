// SPDX-License-Identifier: Apache-2.0
// The distance between a picture's rays, and the settings derived from it: whether subtiles begin with cones, the size
// of the hull used for subtiles, and the lattices of pixels.
#pragma once

#include <cmath>

#include "backends/openmp/variant.h"
#include "core/render/backend.h"
#include "core/scene/fractal.h"

namespace mandelmarch::openmp {

// Returns the length of a vector of the kernel's scene.
template <class Triple>
auto length_of(const Triple& a) -> decltype(a.x + 0)
{
    return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

// Returns the max distance between two diagonally adjacent rays, measured at distance 1 from the camera.
template <class KernelScene>
auto spacing_of(const KernelScene& scene) -> decltype(scene.tolerance + 0)
{
    using Real = decltype(scene.tolerance + 0);
    return 2 * std::hypot(length_of(scene.across) / static_cast<Real>(scene.width),
                          length_of(scene.upward) / static_cast<Real>(scene.height));
}

// Returns the lattices of a picture. The pixels of the coarsest lattice are so close together that rays of the pixels
// in between can begin near the lattice's hits (neighbour_pitch).
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

// Returns true if pixels may share occlusion with adjacent pixels. Requires that normals ignore details smaller than a
// tolerance, and that adjacent pixels are closer together than the shortest distance at which openness is evaluated
// (core/kernel/looks.h).
template <class KernelScene>
bool shares_surroundings(const Scene& scene, const KernelScene& kernel, const Techniques& techniques)
{
    constexpr double nearest_openness = 0.004;  // as a fraction of the distance from the camera
    return techniques.shared_occlusion && scene.smooth && scene.colouring > 1 && spacing_of(kernel) < nearest_openness;
}

// Returns true if subtiles begin with cones. A cone ends several of its widths in front of the surface. If a pixel is
// many tolerances wide, a cone can end as soon as it begins, and then costs more time than it saves.
template <class KernelScene>
bool cones_pay(const KernelScene& scene, const Fractal& fractal, const Techniques& techniques)
{
    return scene.canonical != 0 && techniques.cones && spacing_of(scene) < fractal.fast.cone_pitch * scene.tolerance;
}

// Returns the size of an enlarged hull for subtiles; 0 if the scene has no hull. If any ray of a subtile meets the
// scene's hull, the subtile's centre ray meets the enlarged one. Rays leave the scene's hull no farther than `farthest`
// from the eye. At that distance, each ray of a subtile is at most half the subtile's diagonal away from the centre
// ray.
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
