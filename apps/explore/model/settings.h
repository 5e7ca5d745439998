// SPDX-License-Identifier: Apache-2.0
// Settings that explore keeps from run to run in $XDG_CONFIG_HOME/mandelmarch/explore.json.
#pragma once

#include <string>

#include "apps/explore/model/setup.h"
#include "core/scene/scene.h"

namespace mandelmarch::explore {

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
