// SPDX-License-Identifier: Apache-2.0
// What a scene is told beside its parameter file: --estimate, --projection, --eyes.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// `name` is the default, too.
inline void add_estimate_option(CLI::App& app, std::string& name)
{
    app.add_option(
           "--estimate", name,
           "counted: the original's distance estimate; conservative: one that is seldom larger than the distance")
        ->check(CLI::IsMember({std::string(counted_estimate), std::string(conservative_estimate)}))
        ->capture_default_str();
}

inline void add_projection_option(CLI::App& app, Projection& projection)
{
    app.add_option("--projection", projection,
                   "perspective; equirectangular: all directions, 360 degrees wide and 180 high")
        ->transform(CLI::Transformer(std::map<std::string, Projection>{
            {"perspective", Projection::perspective}, {"equirectangular", Projection::equirectangular}}))
        // Of what was given, before: Transformer lets other words through.
        ->transform(CLI::IsMember({"perspective", "equirectangular"}))
        ->default_str("perspective");
}

// Throws InputError for a picture of all directions that is not 360 by 180 degrees. `pictures`: 2 for two eyes, whose
// pictures stand side by side.
inline void check_panorama(Projection projection, int width, int height, int pictures = 1)
{
    if (projection != Projection::equirectangular || width == 2 * pictures * height) return;
    throw InputError(
        fmt::format("--projection equirectangular: {} x {} pixels given, expected {} times as wide as high (360 by 180 "
                    "degrees{}), --size {}x1080, say",
                    width, height, 2 * pictures, pictures == 2 ? " for each eye" : "", 2160 * pictures));
}

}  // namespace mandelmarch
