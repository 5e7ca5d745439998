// SPDX-License-Identifier: Apache-2.0
// Reads parameter files (.dat). They are text, with one entry per line in a fixed order; `#` begins a comment.
//     const ParameterFile file = read_parameters("paramsBox.dat", fractal_named("box"));
//     for (const std::string& warning : file.warnings) say("{}\n", warning);
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch {

struct ParameterFile {
    Scene scene;
    std::vector<std::string> warnings;  // each has the form `file:line: text`
    bool comment_behind_name = false;   // a comment follows the name of the image file
    bool super_sampling = false;        // the file has the older format, and its super-sampling is on
};

// Parses `text` as a parameter file for `fractal`; messages call it `name`. Accepts a byte-order mark, line ends CR
// LF, tabs, leading and trailing spaces, a missing last line end, and a comment after a value. Also accepts an older
// format, in which a number (super-sampling) precedes the name of the image file, and adds a warning. Real numbers of
// the entries 6, 7, 8 and 10 are rounded to single precision, as in the original program. Throws InputError with a
// message of the form `name:line: what is wrong, what was expected`.
ParameterFile parse_parameters(std::string_view text, const std::string& name, const Fractal& fractal);

// Reads and parses a parameter file. Also throws InputError if the file cannot be read.
ParameterFile read_parameters(const std::string& path, const Fractal& fractal);

// Returns the scene of the fractal's official parameter file. The second function changes the picture's size.
Scene official_scene(const Fractal& fractal);
Scene official_scene(const Fractal& fractal, int width, int height);

// Returns the text of a parameter file from which this scene can be read. Values of the entries 6, 7, 8 and 10 must be
// rounded to single precision.
std::string to_parameters(const Scene& scene);

}  // namespace mandelmarch
