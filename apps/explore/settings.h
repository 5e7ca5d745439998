// SPDX-License-Identifier: Apache-2.0
// Settings kept between runs, in $XDG_CONFIG_HOME/mandelmarch/explore.json.
#pragma once

#include <string>

#include "apps/explore/setup.h"

namespace mandelmarch::explore {

struct Settings {
    int width = 960, height = 540;  // of the window, pixels
    Setup setup{"openmp", 0, Precision::f32, Mode::fast};
    double speed = 1;
    double scale = 1;  // of the text size
    bool collides = true;
    bool panel = true;
    bool statistics = true;
};

// Returns the file's path; empty if neither XDG_CONFIG_HOME nor HOME is set.
std::string settings_file();

// Returns the file's settings, with defaults for missing ones. An invalid file is ignored, and `said` says so.
Settings read_settings(const std::string& file, std::string& said);

// Throws Error.
void write_settings(const std::string& file, const Settings& settings);

}  // namespace mandelmarch::explore
