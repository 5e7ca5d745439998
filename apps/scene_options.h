// SPDX-License-Identifier: Apache-2.0
// Options that several programs share. --estimate and --projection set properties of a scene that a parameter file does
// not contain.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <string>

#include "apps/cli/arguments.h"
#include "apps/cli/option_values.h"
#include "core/text/text.h"
#include "core/text/error.h"
#include "core/render/backend.h"
#include "core/scene/fractal.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// Adds --fractal. `name` contains the default, and receives the value.
inline CLI::Option* add_fractal_option(CLI::App& app, std::string& name)
{
    const auto names = mapped(fractals(), &Fractal::name);
    return app.add_option("--fractal", name, fmt::format("fractal: {}", fmt::join(names, ", ")));
}

inline void add_threads_option(CLI::App& app, int& threads)
{
    app.add_option("--threads", threads, "host threads; 0 (default): one per core that the process may use")
        ->check(whole(0, 1024));
}

// Adds --estimate. `conservative`: true for the fractal's conservative estimate.
inline void add_estimate_option(CLI::App& app, bool& conservative)
{
    add_choice(
        app, "--estimate", conservative,
        {{std::string(original_estimate), false}, {std::string(conservative_estimate), true}},
        "distance estimate; original: the formula of the original program, which exact mode reproduces; conservative: "
        "rarely more than the true distance");
}

inline void add_projection_option(CLI::App& app, Projection& projection)
{
    add_choice(app, "--projection", projection,
               {{"perspective", Projection::perspective}, {"equirectangular", Projection::equirectangular}},
               "perspective, or equirectangular (all directions, 360 x 180 degrees)");
}

inline void add_precision_options(CLI::App& app, RendererOptions& options)
{
    add_choice(app, "--precision", options.precision, {{"double", Precision::f64}, {"float", Precision::f32}},
               "floating-point precision");
    add_choice(app, "--mode", options.mode, {{"exact", Mode::exact}, {"fast", Mode::fast}},
               "exact: same bits on every backend but reference; fast: fewer steps, FMA allowed");
}

// Returns the number of equirectangular pictures side by side; 0: the pictures are perspective.
inline int panoramas(Projection projection, bool stereo)
{
    return projection == Projection::perspective ? 0 : stereo ? 2 : 1;
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
