// SPDX-License-Identifier: Apache-2.0
// Whether a scene's picture shows anything, and what it should: judged by a small picture of about a thousand rays.
#pragma once

#include <string>
#include <vector>

#include "core/render/backend.h"

namespace mandelmarch {

struct Survey {
    int rays = 0;
    double hit = 0;           // share of the rays that hit the surface
    double out_of_steps = 0;  // share that took all the steps there are and hit nothing
    bool inside = false;      // the orbit of the eye's place does not escape: it stands in the solid
    double lost = 0;          // float: the share of pixels that differ visibly from those in double; 0 in double
};

// Of the scene as `renderer` draws it, which was made with these options; `other` draws it in double, where that is in
// float. `eyes`: the distance of two eyes, whose pictures count both; 0 for one.
Survey survey_of(const Scene& scene, double eyes, const RendererOptions& options, Renderer& renderer,
                 const Backend& other);

// Throws InputError where every ray ends in the solid in which it begins, so that there is no picture. `one_colour`:
// the whole picture has one colour. The text begins with `where`.
void refuse_solid(const Survey& survey, bool one_colour, const std::string& where);

// What the user should know, a line each; nothing where all is well.
std::vector<std::string> words_of(const Survey& survey, const Scene& scene, bool one_colour);

// True where all of the picture's pixels have the same bytes.
bool has_one_colour(const Image& image);

}  // namespace mandelmarch
