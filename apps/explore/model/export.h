// SPDX-License-Identifier: Apache-2.0
// Export: writes the view as a parameter file, from which bin/render makes the same picture.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "apps/explore/model/settings.h"
#include "core/render/registry.h"

namespace mandelmarch::explore {

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
