// SPDX-License-Identifier: Apache-2.0
// Setups, and the settings that explore keeps from run to run in $XDG_CONFIG_HOME/mandelmarch/explore.json.
#pragma once

#include <fmt/format.h>

#include <compare>
#include <string>

#include "core/render/registry.h"
#include "core/scene/scene.h"
#include "core/text/error.h"

namespace mandelmarch::explore {

// The backend, device, precision and mode with which a picture is rendered.
struct Setup {
    std::string backend;
    int device = 0;
    Precision precision = Precision::f32;
    Mode mode = Mode::fast;

    auto operator<=>(const Setup&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 misreads <=>
};

inline std::string name_of(const Setup& setup)
{
    return fmt::format("{}{} {} {}", setup.backend, setup.device > 0 ? fmt::format(":{}", setup.device) : "",
                       mandelmarch::name_of(setup.precision), mandelmarch::name_of(setup.mode));
}

inline Setup with_other_precision(Setup setup)
{
    setup.precision = setup.precision == Precision::f32 ? Precision::f64 : Precision::f32;
    return setup;
}

inline Setup with_other_mode(Setup setup)
{
    setup.mode = setup.mode == Mode::fast ? Mode::exact : Mode::fast;
    return setup;
}

// Returns the setup for a device of another backend. The reference backend gets double, the only precision it supports.
inline Setup with_device(const Setup& setup, const Backend& backend, int device)
{
    return {std::string(backend.name()), device,
            backend.info().role == Role::reference ? Precision::f64 : setup.precision, setup.mode};
}

inline const Backend& backend_of(const Registry& registry, const Setup& setup)
{
    const Backend* backend = registry.find(setup.backend);
    if (backend == nullptr) throw Unavailable("there is no backend " + setup.backend);
    return *backend;
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

struct Settings {
    int width = 960, height = 540;  // size of the window in pixels
    Setup setup{"openmp", 0, Precision::f32, Mode::fast};
    int look = default_look;  // colouring type of the official scenes at the start
    double speed = 1;         // Motion::speed
    double scale = 1;         // factor on the size of text
    bool collides = true;
    bool panel = true;
    bool statistics = true;
};

// Returns the path of the settings file; empty if neither XDG_CONFIG_HOME nor HOME is set.
std::string settings_file();

// Returns the settings in the file, and defaults for settings that the file does not contain. An invalid file is
// ignored; `said` is then set to a message for the user.
Settings read_settings(const std::string& file, std::string& said);

// Writes the file. Throws Error if that fails.
void write_settings(const std::string& file, const Settings& settings);

}  // namespace mandelmarch::explore
