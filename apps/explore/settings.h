// SPDX-License-Identifier: Apache-2.0
// What is kept from one run to the next, in $XDG_CONFIG_HOME/mandelmarch/explore.json.
#pragma once

#include <string>

#include "apps/explore/setup.h"

namespace mandelmarch::explore {

struct Settings {
    int width = 960, height = 540;  // of the window, pixels
    Setup setup{"openmp", 0, Precision::f32, Mode::fast};
    double speed = 1;
    double scale = 1;  // of texts
    bool collides = true;
    bool panel = true;
    bool statistics = true;
};

// Where they are kept; empty where there is no place, as neither XDG_CONFIG_HOME nor HOME is set.
std::string settings_file();

// What the file says, and the usual values for what it does not. A file that cannot be understood is as good as none;
// `said` then says so.
Settings read_settings(const std::string& file, std::string& said);

// Throws Error.
void write_settings(const std::string& file, const Settings& settings);

}  // namespace mandelmarch::explore
