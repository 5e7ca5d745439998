// SPDX-License-Identifier: Apache-2.0
// Setups, and the files that explore writes and reads: the settings that it keeps from run to run in
// $XDG_CONFIG_HOME/mandelmarch/explore.json, parameter files, from which bin/render makes the same picture, and places.
#pragma once

#include <fmt/format.h>

#include <compare>
#include <span>
#include <string>
#include <string_view>

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

// Resets the properties of a scene that a parameter file does not contain, such as those of films. The kind of estimate
// is kept.
void as_file(Scene& scene);

// Returns the text of the view's parameter file. If the estimate is conservative, a comment records it.
std::string view_text(const Scene& scene);

// Returns the command of bin/render that makes the same picture. `file`: the scene's parameter file.
std::string command_of(const Scene& scene, const Setup& setup, const std::string& file);

// Returns the first of FOLDER/STEM-001, FOLDER/STEM-002, ... for which no file with the extension .dat, .png, .json or
// .mp4 exists.
std::string free_name(const std::string& folder, const std::string& stem);

// Appends the view to a places file (flight/path/places.h), which is created if it does not exist. Returns how many
// places the file then has. Throws InputError if the file is not a places file.
std::size_t append_place(const std::string& file, const Scene& scene);

// Returns the scene of a parameter file. The fractal is found by its name in the file's text or in the file's name. If
// neither contains a fractal's name, the fractal is `hint`. Throws InputError with a message that begins with the
// file's name and line.
Scene read_view(const std::string& file, const Fractal& hint);
Scene view_of_text(const std::string& text, const std::string& name, const Fractal& hint);

struct StartView {
    std::string_view name;     // such as "reef"
    std::string_view fractal;  // the fractal's name
    std::string_view text;     // text of the parameter file
};

// Returns the views whose fractals this build has, sorted by name. May be empty.
std::span<const StartView> start_views();

}  // namespace mandelmarch::explore
