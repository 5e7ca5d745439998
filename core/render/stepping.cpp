// SPDX-License-Identifier: Apache-2.0
#include "core/render/stepping.h"

#include <algorithm>

#include "core/scene/fractal.h"

namespace mandelmarch {

Stepping stepping_of(const Scene& scene, Mode mode, const Techniques& techniques)
{
    const Fractal& fractal = *scene.fractal;
    const bool fast = mode == Mode::fast;
    const double stride =
        std::min(scene.limits.stride, fast ? fractal.fast.stride.value(inputs_of(scene)) : plain_stride);
    // Scenes that need short steps are not over-relaxed.
    const bool relaxed = fast && techniques.relaxation && stride >= plain_stride;
    return {
        .stride = stride,
        .relaxation = relaxed ? longest_relaxed : stride,
        .root_share = techniques.root ? std::max(scene.limits.root_share, fractal.fast.root_share) : any_root_share};
}

StepLimits film_limits(const Scene& scene)
{
    return {.stride = std::min(scene.limits.stride, scene.fractal->flight.trust_of(scene).stride),
            .root_share = std::max(scene.limits.root_share, film_root_share)};
}

}  // namespace mandelmarch
