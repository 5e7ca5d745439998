// SPDX-License-Identifier: Apache-2.0
// Judges from a small picture of about a thousand rays whether a scene's picture shows anything, and shows it rightly.
#pragma once

#include <string>
#include <vector>

#include "core/render/backend.h"

namespace mandelmarch {

struct Survey {
    int rays = 0;
    double hit = 0;           // share of the rays that hit the surface
    double out_of_steps = 0;  // share of the rays that used up all their steps and hit nothing
    bool inside = false;      // the eye stands in the solid: the orbit of its position does not escape
    double lost = 0;          // in float, the share of pixels that differ visibly from the picture in double; else 0
};

// Surveys the scene as `renderer` draws it. `options` are the renderer's; if they ask for float, `other` also draws the
// scene in double. `eyes`: the distance between two eyes, whose pictures count equally; 0 for one eye.
Survey survey_of(const Scene& scene, double eyes, const RendererOptions& options, Renderer& renderer,
                 const Backend& other);

// Throws InputError if the camera stands in the solid, so that no ray sees anything. `one_colour`: the whole picture
// has one colour. The message begins with `where`.
void refuse_solid(const Survey& survey, bool one_colour, const std::string& where);

// The warnings for the user, one line each; empty if all is well.
std::vector<std::string> words_of(const Survey& survey, const Scene& scene, bool one_colour);

// True if all pixels have the same three bytes.
bool has_one_colour(const Image& image);

}  // namespace mandelmarch
