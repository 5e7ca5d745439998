// SPDX-License-Identifier: Apache-2.0
// Reads parameter files (.dat): text, one entry a line in a fixed order, `#` begins a comment.
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

// Parses `text` as a parameter file for `fractal`. `name` is what messages call the file.
// Accepts a byte-order mark, CR LF line ends, tabs, leading and trailing space, a missing last line end, and a comment
// behind a value. An older variant with one more whole number (super-sampling) before the file name gets a warning.
// The real numbers of the entries 6, 7, 8 and 10 are rounded to single precision, as the original program did.
// Throws InputError, `name:line: what is wrong, what was expected`.
ParameterFile parse_parameters(std::string_view text, const std::string& name, const Fractal& fractal);

// The same for a file. Throws InputError, too, if it cannot be read.
ParameterFile read_parameters(const std::string& path, const Fractal& fractal);

// The scene of a fractal's own file, which its row holds.
Scene official_scene(const Fractal& fractal);
Scene official_scene(const Fractal& fractal, int width, int height);

// The text of a parameter file that reads as this scene, where its reals of the entries 6, 7, 8 and 10 are single.
std::string to_parameters(const Scene& scene);

}  // namespace mandelmarch
