// SPDX-License-Identifier: Apache-2.0
// Where the time of openmp's pictures goes: its scheduler with a clock between the stages.
#pragma once

#include <array>
#include <memory>

#include "backends/openmp/stage.h"
#include "core/image/image.h"
#include "core/render/backend.h"

namespace mandelmarch::openmp {

struct StageSeconds {
    std::array<double, stages> of{};  // by Stage
    double in_one_go = 0;             // of the whole picture as openmp draws it, without a clock
};

// Draws pictures of one scene on one thread, with the variant that openmp takes when nothing is counted.
class Profiler {
public:
    virtual ~Profiler() = default;

    // Draws the picture stage by stage into `image`, which has bytes, and once more in one go.
    virtual StageSeconds draw(Image& image) = 0;
};

// Throws Unavailable where openmp has no packs on this machine, or none of the fractal.
std::unique_ptr<Profiler> make_profiler(const Scene& scene, Precision precision, Mode mode);

}  // namespace mandelmarch::openmp
