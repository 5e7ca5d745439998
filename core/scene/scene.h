// SPDX-License-Identifier: Apache-2.0
// A scene: which fractal, seen from where, drawn how. What a parameter file says, as read, and what whoever draws it
// asks of the steps.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>

#include "core/scene/vector.h"

namespace mandelmarch {

struct Fractal;

inline constexpr int max_side = 65535;           // pixels
inline constexpr int max_iterations = 10'000;    // of the distance estimator
inline constexpr double degrees_per_field = 65;  // of vertical angle, in a unit of the field of view
inline constexpr double max_field_of_view = 180 / degrees_per_field;
inline constexpr int colouring_types = 5;  // 0 and 1: the original's; from 2: core/kernel/looks.h

// A step of the original program, in distance estimates.
inline constexpr double plain_stride = 0.95;

// The names of distance estimates: the original program's, and the fractal's conservative one (core/scene/fractal.h).
inline constexpr std::string_view counted_estimate = "counted";
inline constexpr std::string_view conservative_estimate = "conservative";

// What a film or a trial asks of a ray's steps; no part of a parameter file (core/render/stepping.h).
struct StepLimits {
    double stride = plain_stride;  // no plain step is longer; in distance estimates
    double root_share = 0;         // no hit has to be nearer to the surface; in tolerances
};

// How a picture's places are directions. equirectangular: its width is 360 degrees of longitude, its height 180 of
// latitude, whatever the field of view.
enum class Projection { perspective, equirectangular };

// The part of a larger picture that a scene draws, in pixels of that picture; the scene's size is the part's.
struct Part {
    int left = 0, bottom = 0;
    int whole_width = 0, whole_height = 0;  // 0: the scene draws all of it
};

struct Scene {
    const Fractal* fractal = nullptr;
    Vector eye{7, 7, 7};
    Vector target{0, 0, 0};
    Vector up{0, 1, 0};
    double field_of_view = 1;                // in units of degrees_per_field; 0 < f < max_field_of_view
    int width = 0, height = 0;               // pixels, 1 to max_side
    double detail = -3;                      // a surface is hit where DE < 10^detail * t
    std::array<double, 3> shape{2, 0.5, 1};  // line 7; the fractal says what the three mean
    int iterations = 1;                      // n, 1 to max_iterations
    double escape = 0;                       // line 8, second value
    int colouring = 0;
    double brightness = 1;
    std::string image_file;

    // No part of a parameter file, as the original program knows none of them:
    bool conservative = false;  // the distance estimate is the fractal's conservative one
    bool smooth = false;        // normals see nothing that is smaller than a tolerance
    bool centred = false;       // rays go through the pixels' middles, not their lower left corners
    Projection projection = Projection::perspective;
    Vector sun{0.48, 0.64, 0.6};  // a unit vector towards it, for colouring types from 2 up
    StepLimits limits;
    Part part;
};

// The entries of a parameter file, in their order.
enum class Item { eye, target, up, field_of_view, size, detail, shape, iterations, colouring, brightness, image_file };
inline constexpr int item_count = 11;

// Throws InputError if the values are fine one by one but not together: the camera stands on its target, `up` is
// parallel to the view, or the fractal cannot be computed with these constants. The text begins with where(item).
void check_scene(const Scene& scene, const std::function<std::string(Item)>& where);

}  // namespace mandelmarch
