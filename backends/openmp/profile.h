// SPDX-License-Identifier: Apache-2.0
// Measures the time of each stage of a picture rendered by openmp (packs/profile.h).
#pragma once

#include <array>
#include <memory>

#include "backends/openmp/variant.h"
#include "core/image/image.h"
#include "core/render/backend.h"

namespace mandelmarch::openmp {

// Render times in seconds.
struct StageSeconds {
    std::array<double, stages> of{};  // by Stage
    double in_one_go = 0;             // of the same picture, rendered without a clock
};

// Renders pictures of one scene on one thread, with the variant that openmp uses if no work is counted.
class Profiler {
public:
    virtual ~Profiler() = default;

    // Renders the picture stage by stage into `image`, which must have bytes, and a second time without a clock.
    virtual StageSeconds draw(Image& image) = 0;
};

// Throws Unavailable if openmp has no packs on this machine or for this fractal.
std::unique_ptr<Profiler> make_profiler(const Scene& scene, Precision precision, Mode mode);

}  // namespace mandelmarch::openmp
