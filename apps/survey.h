// SPDX-License-Identifier: Apache-2.0
// Detects whether the picture of a scene is empty or wrong, by rendering a small picture of about a thousand rays, and
// writes the statistics of --stats.
#pragma once

#include <string>
#include <vector>

#include "core/render/backend.h"

namespace mandelmarch {

struct Survey {
    int rays = 0;
    double hit = 0;           // fraction of rays that hit the surface
    double out_of_steps = 0;  // fraction of rays that reached the maximum number of steps without a hit
    bool inside = false;      // the eye is inside the solid: the orbit of its position does not escape
    double lost = 0;          // float: fraction of pixels that differ visibly from the picture in double; double: 0
};

// Surveys the scene as rendered by `renderer`, which was created with `options`. If the precision is float, the backend
// `other` renders the scene in double for comparison. `eyes`: distance between the two eyes of a stereo picture; 0: one
// eye. If there are two eyes, the results are means of both.
Survey survey_of(const Scene& scene, double eyes, const RendererOptions& options, Renderer& renderer,
                 const Backend& other);

// Throws InputError if the camera is inside the solid and the whole picture has one colour (`one_colour`). The message
// begins with `where`.
void refuse_solid(const Survey& survey, bool one_colour, const std::string& where);

// Returns warnings for the user, one line each.
std::vector<std::string> words_of(const Survey& survey, const Scene& scene, bool one_colour);

// Returns a warning for the user about a view that was not surveyed, or "". `clearance`: the distance estimate at the
// eye. `one_colour`: the view's picture is complete and has a single colour.
std::string view_warning(const Scene& scene, double clearance, Precision precision, bool one_colour);

// Returns true if all pixels have the same three bytes.
bool has_one_colour(const Image& image);

// Writes the output of --stats to the file `path`: configuration, times (in seconds) and work counts as JSON. Throws
// Error if the file cannot be written.
void write_stats(const std::string& path, const Scene& scene, const RenderStats& report, const Survey& survey,
                 const std::vector<std::string>& warnings);

}  // namespace mandelmarch
