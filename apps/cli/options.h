// SPDX-License-Identifier: Apache-2.0
// Parsers for values of command line options. If a value is invalid, they throw InputError with a message that names
// the option, the given value and the allowed values.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/image/image.h"
#include "core/render/backend.h"
#include "core/render/region.h"
#include "core/render/registry.h"
#include "core/scene/fractal.h"
#include "core/scene/scene.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch {

// Return checks of an option whose value is a number from `low` to `high`, for CLI::Option::check().
CLI::Validator whole(std::int64_t low, std::int64_t high);
CLI::Validator real(double low, double high);

// Parses an integer from `low` to `high`. `name`: the option's name without dashes.
int whole_option(const std::string& name, const std::string& text, int low, int high);

// Parses two integers from `low` to `high`, separated by the character `between`. `expected`: the allowed values, in
// words for the error message.
std::pair<int, int> pair_option(const std::string& name, const std::string& text, char between, int low, int high,
                                const std::string& expected);

// Return the device file of standard input or output if the name is `-`, and any other name unchanged. A file that is
// called `-` can be given as `./-`.
std::string input_name(const std::string& name);
std::string output_name(const std::string& name);

// Parses a picture's size: WIDTHxHEIGHT in pixels, or a name such as 4k. Neither side may exceed `most_side`.
// `panoramas`: the number of equirectangular pictures side by side, 0 for perspective pictures. With panoramas, a name
// stands for this width of each and for half of it as the height.
std::pair<int, int> size_option(const std::string& text, int most_side = max_side, int panoramas = 0);

// Parses a region of a picture of `width` x `height` pixels: X,Y,WIDTH,HEIGHT or X,Y,WIDTHxHEIGHT. X,Y is the region's
// bottom left pixel, counted from the picture's bottom left.
Region region_option(const std::string& text, int width, int height);

// Parses the arguments. After --help or --version, returns the exit code with which the program should end; otherwise
// nullopt. Throws InputError if an argument is invalid or empty; the message begins with `program` and its command.
std::optional<int> parse_arguments(CLI::App& app, const std::string& program, int argc, char** argv);

// Throws InputError if an option was given that is not one of `taken`. `mode`: the option that selects what the program
// does.
void refuse_others(const CLI::App& app, const std::string& mode, const std::vector<std::string>& taken);

// Adds an option that sets `value` to one of the named values. Its default is the current value.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& option, Value& value,
                        std::vector<std::pair<std::string, Value>> choices, const std::string& about)
{
    std::vector<std::string> names;
    std::string chosen;
    for (const auto& [name, choice] : choices) {
        names.push_back(name);
        if (choice == value) chosen = name;
    }
    const auto set = [&value, choices = std::move(choices)](const std::string& text) {
        value = std::ranges::find(choices, text, &std::pair<std::string, Value>::first)->second;
    };
    return app.add_option_function<std::string>(option, set, about)->check(CLI::IsMember(names))->default_str(chosen);
}

// Adds --backend and --no-isolation. `name` holds the default of --backend, and receives its value.
void add_backend_option(CLI::App& app, std::string& name, const Registry& registry);

// Adds --no-isolation, for programs without --backend. The option appears in the help and is accepted, but has no
// effect here, because program_backends() evaluates it before the program parses its arguments.
void add_isolation_option(CLI::App& app);

// Returns the backend called `name`. If `name` is "auto", this is the backend of Registry::automatic() or, if that
// backend does not support the options, the host's backend. For "auto" and if `tells` is true, also prints the choice
// with its reason.
const Backend& chosen_backend(const Registry& registry, const std::string& name, bool tells,
                              const RendererOptions& options = {});

// Throws InputError if the options set a number of threads or a SIMD width, and the backend does not support the option
// for it, --threads or --simd-width.
void refuse_unheeded(const Registry& registry, const Backend& backend, const RendererOptions& options);

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

// Adds --look, whose value is the number or name of a colouring type, or a look file; `file` then receives its name.
// `usual`: the default, in words for the help.
void add_look_option(CLI::App& app, std::optional<ChosenLook>& look, std::string& file, const std::string& usual);

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
