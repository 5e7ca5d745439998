// SPDX-License-Identifier: Apache-2.0
// A setup: the backend, device, precision and mode with which a picture is rendered.
#pragma once

#include <fmt/format.h>

#include <compare>
#include <string>

#include "core/render/backend.h"

namespace mandelmarch::explore {

struct Setup {
    std::string backend;
    int device = 0;
    Precision precision = Precision::f32;
    Mode mode = Mode::fast;

    auto operator<=>(const Setup&) const = default;
};

inline std::string name_of(const Setup& setup)
{
    return fmt::format("{}{} {} {}", setup.backend, setup.device > 0 ? fmt::format(":{}", setup.device) : "",
                       mandelmarch::name_of(setup.precision), mandelmarch::name_of(setup.mode));
}

// Returns the renderer's options for a setup. Work is not counted, as in bin/render without --stats.
inline RendererOptions options_of(const Setup& setup)
{
    RendererOptions options;
    options.device = setup.device;
    options.precision = setup.precision;
    options.mode = setup.mode;
    options.counts = false;
    return options;
}

}  // namespace mandelmarch::explore
