// SPDX-License-Identifier: Apache-2.0
// Time of each stage of openmp's pictures: its ray scheduler with a clock between the stages.
#pragma once

#include <array>
#include <memory>

#include "backends/openmp/stage.h"
#include "core/image/image.h"
#include "core/render/backend.h"

namespace mandelmarch::openmp {

struct StageSeconds {
    std::array<double, stages> of{};  // by Stage
    double in_one_go = 0;             // the whole picture as openmp renders it, without a clock
};

// Renders pictures of one scene on one thread, with the variant that openmp uses without counting.
class Profiler {
public:
    virtual ~Profiler() = default;

    // Renders the picture stage by stage into `image`, which has bytes, and a second time without a clock.
    virtual StageSeconds draw(Image& image) = 0;
};

// Throws Unavailable if openmp has no packs on this machine, or none for the fractal.
std::unique_ptr<Profiler> make_profiler(const Scene& scene, Precision precision, Mode mode);

}  // namespace mandelmarch::openmp
