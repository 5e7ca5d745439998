// SPDX-License-Identifier: Apache-2.0
// Reads parameter files (.dat): text, one entry per line in a fixed order, `#` begins a comment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch {

struct ParameterFile {
    Scene scene;
    std::vector<std::string> warnings;  // each `file:line: text`
    bool comment_behind_name = false;   // a comment follows the image's file name
    bool super_sampling = false;        // an older format's switch is on
};

// Parses `text` as a parameter file for `fractal`. `name` is used in messages. Accepts a byte-order mark, CR LF line
// ends, tabs, leading and trailing spaces, a missing last line end, and a comment after a value. An older variant with
// one more integer (super-sampling) before the file name gets a warning. Real numbers of the entries 6, 7, 8 and 10 are
// rounded to single precision, as in the original program. Throws InputError, `name:line: what is wrong, what was
// expected`.
ParameterFile parse_parameters(std::string_view text, const std::string& name, const Fractal& fractal);

// The same for a file. Also throws InputError if it cannot be read.
ParameterFile read_parameters(const std::string& path, const Fractal& fractal);

// Returns the scene of the fractal's official parameter file, optionally in another size.
Scene official_scene(const Fractal& fractal);
Scene official_scene(const Fractal& fractal, int width, int height);

// Returns a parameter file that reads as this scene, if its reals of the entries 6, 7, 8 and 10 have single precision.
std::string to_parameters(const Scene& scene);

}  // namespace mandelmarch
