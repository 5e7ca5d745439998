// SPDX-License-Identifier: Apache-2.0
// The distance between a picture's rays, and what follows from it: whether rays begin at the ends of cones, the size of
// the hull used for subtiles, and the lattices of pixels.
#pragma once

#include <cmath>

#include "core/render/backend.h"
#include "core/render/lattice.h"
#include "core/scene/fractal.h"

namespace mandelmarch {

// Returns the length of a vector of the kernel's scene.
template <class Triple>
auto length_of(const Triple& a) -> decltype(a.x + 0)
{
    return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

// Returns Scene::spacing of core/kernel/scene.h: the max distance between two diagonally adjacent rays, measured at
// distance 1 from the camera.
template <class KernelScene>
auto spacing_of(const KernelScene& scene) -> decltype(scene.tolerance + 0)
{
    using Real = decltype(scene.tolerance + 0);
    return 2 * std::hypot(length_of(scene.across) / static_cast<Real>(scene.width),
                          length_of(scene.upward) / static_cast<Real>(scene.height));
}

// Returns Scene::subtile_hull: the size of an enlarged hull for subtiles; 0 if the scene has no hull. If any ray of a
// subtile meets the scene's hull, the subtile's centre ray meets the enlarged one. Rays leave the scene's hull no
// farther than `farthest` from the eye. At that distance, each ray of a subtile is at most half the subtile's diagonal
// away from the centre ray.
template <class KernelScene>
auto subtile_hull_of(const KernelScene& scene, const Fractal& fractal) -> decltype(scene.tolerance + 0)
{
    using Real = decltype(scene.tolerance + 0);
    if (!(scene.hull > 0)) return 0;
    const Real farthest = length_of(scene.eye) + static_cast<Real>(fractal.hull.corner) * scene.hull;
    const Real rounding = Real(1.001);
    return rounding * (scene.hull + spacing_of(scene) * Real(subtile_side) / 2 * farthest);
}

// Returns the lattices of a picture. The pixels of the coarsest lattice are so close together that rays of the pixels
// in between can begin near the lattice's hits (neighbour_pitch).
template <class KernelScene>
Lattices lattices_of(const KernelScene& scene, const Fractal& fractal, const Techniques& techniques)
{
    if (scene.canonical == 0 || !techniques.neighbours) return all_at_once;
    int apart = 4;
    while (apart > 1 && apart * scene.spacing > fractal.fast.neighbour_pitch * scene.tolerance) apart /= 2;
    Lattices lattices{{{0, apart}}, 1};
    for (; apart > 1; apart /= 2) lattices.of[lattices.count++] = {apart, apart / 2};
    return lattices;
}

// Returns true if rays begin at the ends of cones. A cone ends several of its widths in front of the surface. If a
// pixel is many tolerances wide, a cone can end as soon as it begins, and then costs more time than it saves.
template <class KernelScene>
bool cones_pay(const KernelScene& scene, const Fractal& fractal, const Techniques& techniques)
{
    return scene.canonical != 0 && techniques.cones && scene.spacing < fractal.fast.cone_pitch * scene.tolerance;
}

// Returns the passes of a picture that find where its rays begin, for a device that marches the cones `outer`, then
// `inner` (the sides of their tiles; 0: none), and that renders lattices if `neighbours` is set.
template <class KernelScene>
Starts starts_of(const KernelScene& scene, const Fractal& fractal, const Techniques& techniques, int outer, int inner,
                 bool neighbours)
{
    Starts starts;
    if (cones_pay(scene, fractal, techniques)) {
        for (const int side : {outer, inner}) {
            const int within = starts.tile_side();
            if (side > 0) starts.cones[starts.cone_passes++] = {side, within};
        }
    }
    if (neighbours) starts.lattices = lattices_of(scene, fractal, techniques);
    return starts;
}

}  // namespace mandelmarch
