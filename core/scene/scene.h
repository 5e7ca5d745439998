// SPDX-License-Identifier: Apache-2.0
// A scene: the contents of a parameter file as read, and further options of the rendering.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>

#include "core/scene/vector.h"

namespace mandelmarch {

struct Fractal;

inline constexpr int max_iterations = 10'000;    // of the distance estimator
inline constexpr double degrees_per_field = 65;  // vertical angle for a field of view of 1
inline constexpr double max_field_of_view = 180 / degrees_per_field;
inline constexpr int colouring_types = 5;  // 0 and 1: original; from 2: core/kernel/looks.h

// The original program's step factor.
inline constexpr double plain_step_factor = 0.95;

// Names of the distance estimates: the original program's, and the fractal's conservative one (core/scene/fractal.h).
inline constexpr std::string_view counted_estimate = "counted";
inline constexpr std::string_view conservative_estimate = "conservative";

// Limits of a ray's steps set by a film or a trial; not part of a parameter file (core/render/stepping.h).
struct StepLimits {
    double step_factor = plain_step_factor;  // upper limit of the step factor
    double root_share = 0;                   // lower limit of Stepping::root_share, the error of a hit; in tolerances
};

// Mapping from pixels to directions. equirectangular: 360 degrees of longitude across, 180 of latitude upwards,
// independent of the field of view.
enum class Projection { perspective, equirectangular };

// Crop window: the part of a larger picture that a scene shows, in pixels of that picture. The scene's size is that of
// the window.
struct CropWindow {
    int left = 0, bottom = 0;
    int whole_width = 0, whole_height = 0;  // 0: the whole picture
};

struct Scene {
    const Fractal* fractal = nullptr;
    Vector eye{7, 7, 7};
    Vector target{0, 0, 0};
    Vector up{0, 1, 0};
    double field_of_view = 1;                // in units of degrees_per_field; 0 < f < max_field_of_view
    int width = 0, height = 0;               // pixels, 1 to max_side
    double detail = -3;                      // the surface is hit if DE < 10^detail * t
    std::array<double, 3> shape{2, 0.5, 1};  // line 7; the meaning depends on the fractal
    int iterations = 1;                      // n, 1 to max_iterations
    double escape = 0;                       // line 8, second value
    int colouring = 0;
    double brightness = 1;
    std::string image_file;

    // Not part of a parameter file, as the original program has none of these:
    bool conservative = false;  // use the fractal's conservative distance estimate
    bool smooth = false;        // normals ignore detail smaller than a tolerance
    bool centred = false;       // rays through the pixels' centres, not their lower left corners
    Projection projection = Projection::perspective;
    Vector sun{0.48, 0.64, 0.6};  // unit vector towards the sun, for colouring types from 2
    StepLimits limits;
    CropWindow crop_window;
};

// Entries of a parameter file, in order.
enum class Item { eye, target, up, field_of_view, size, detail, shape, iterations, colouring, brightness, image_file };
inline constexpr int item_count = 11;

// Throws InputError if the values are valid separately but not together: the camera is at its target, `up` is parallel
// to the view, or the fractal cannot be computed with these constants. The message begins with where(item).
void check_scene(const Scene& scene, const std::function<std::string(Item)>& where);

}  // namespace mandelmarch
