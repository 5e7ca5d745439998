// SPDX-License-Identifier: Apache-2.0
// The options --estimate and --projection, which set properties of a scene that a parameter file does not contain.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// Adds --estimate. `name`: contains the default, and receives the value.
inline void add_estimate_option(CLI::App& app, std::string& name)
{
    app.add_option("--estimate", name,
                   "distance estimate; counted: the original's, conservative: rarely above the distance")
        ->check(CLI::IsMember({std::string(counted_estimate), std::string(conservative_estimate)}))
        ->capture_default_str();
}

inline void add_projection_option(CLI::App& app, Projection& projection)
{
    app.add_option("--projection", projection, "perspective, or equirectangular (all directions, 360 x 180 degrees)")
        ->transform(CLI::Transformer(std::map<std::string, Projection>{
            {"perspective", Projection::perspective}, {"equirectangular", Projection::equirectangular}}))
        // This check runs before the Transformer, which would accept other words.
        ->transform(CLI::IsMember({"perspective", "equirectangular"}))
        ->default_str("perspective");
}

// Throws InputError if an equirectangular picture is not twice as wide as high. `pictures`: number of pictures side by
// side, which is 2 for stereo.
inline void check_panorama(Projection projection, int width, int height, int pictures = 1)
{
    if (projection != Projection::equirectangular || width == 2 * pictures * height) return;
    throw InputError(
        fmt::format("--projection equirectangular: {} x {} pixels given, expected {} times as wide as high (360 by 180 "
                    "degrees{}), such as --size {}x1080",
                    width, height, 2 * pictures, pictures == 2 ? " for each eye" : "", 2160 * pictures));
}

}  // namespace mandelmarch
