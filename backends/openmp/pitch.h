// How wide the cones of a picture are.
#pragma once

#include <cmath>

#include "core/scene/fractal.h"

namespace mandelmarch::openmp {

// How far apart at distance 1 the rays of two diagonal neighbours are, at most: 0 where cones would not pay. A cone
// ends some of its widths before the surface; where a pixel is many tolerances wide, that can be at once.
template <class KernelScene>
auto pitch_of(const KernelScene& scene, const Fractal& fractal) -> decltype(scene.tolerance)
{
    const auto spacing = [](const auto& axis, int pixels) {
        return 2 * std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z) /
               static_cast<decltype(axis.x + 0)>(pixels);
    };
    const auto pitch = std::hypot(spacing(scene.across, scene.width), spacing(scene.upward, scene.height));
    return pitch < fractal.cone_pitch * scene.tolerance ? pitch : 0;
}

}  // namespace mandelmarch::openmp
