// SPDX-License-Identifier: Apache-2.0
// A scene: the values of a parameter file, and options of the rendering that are not in the file.
//     Scene scene = official_scene(fractal_named("bulb"), 640, 480);  // core/scene/parameter_file.h
//     scene.eye = 0.9 * scene.eye;
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/look.h"
#include "core/scene/vector.h"

namespace mandelmarch {

struct Fractal;

inline constexpr int max_iterations = 10'000;    // max number of iterations of a DE evaluation
inline constexpr double degrees_per_field = 65;  // vertical angle of view for a field of view of 1
inline constexpr double max_field_of_view = 180 / degrees_per_field;

// Names of the colouring types. 0 and 1 are those of the original program, which makes colours from the components of
// the normal, x as red or x as blue. A type with the name of a look (look_named()) is that look. Any other type needs a
// formula in lit() in core/kernel/shade.h.
inline constexpr std::array<std::string_view, 5> colouring_names{"normals as RGB", "normals as BGR", "limestone",
                                                                 "coral", "lagoon"};
inline constexpr int colouring_types = static_cast<int>(colouring_names.size());
inline constexpr int default_look = 3;  // the colouring type of films, and of explore at its first start

// A look that replaces a scene's: a colouring type and, for a look file, its numbers.
struct ChosenLook {
    int colouring = default_look;
    std::optional<LookValues> values = std::nullopt;
};

// The original program's step factor.
inline constexpr double plain_step_factor = 0.95;

// Names of the estimates: the original program's, and the fractal's conservative one (core/scene/fractal.h).
inline constexpr std::string_view original_estimate = "original";
inline constexpr std::string_view conservative_estimate = "conservative";

// Limits of a ray's steps that a film or a trial sets. They are not in the parameter file (core/render/stepping.h).
struct StepLimits {
    double step_factor = plain_step_factor;  // max step factor
    double root_share = 0;                   // min of Stepping::root_share, the error of a hit in tolerances
    bool tried = false;                      // a trial has chosen step_factor; no other trial precedes the picture
    bool operator==(const StepLimits&) const = default;
};

// Mapping from pixels to directions. An equirectangular picture covers 360 degrees of longitude horizontally and 180
// degrees of latitude vertically; it does not depend on the field of view.
enum class Projection { perspective, equirectangular };

// The part of a larger picture that a scene shows, in pixels of the larger picture. Width and height of the part are
// those of the scene.
struct CropWindow {
    int left = 0, bottom = 0;
    int whole_width = 0, whole_height = 0;  // size of the larger picture; 0: the scene shows a whole picture
    bool operator==(const CropWindow&) const = default;
};

// The directions of a look's sky, as unit vectors.
struct Sky {
    Vector up{0, 1, 0};           // at right angles to the horizon
    Vector north{0, 0, 1};        // at right angles to up; the clouds turn with it
    Vector sun{0.48, 0.64, 0.6};  // towards the sun
    bool operator==(const Sky&) const = default;
};

struct Scene {
    const Fractal* fractal = nullptr;
    Vector eye{7, 7, 7};
    Vector target{0, 0, 0};
    Vector up{0, 1, 0};
    double field_of_view = 1;                // in units of degrees_per_field; 0 < f < max_field_of_view
    int width = 0, height = 0;               // pixels, 1 to max_side
    double detail = -3;                      // a sample is a hit if DE < 10^detail * t
    std::array<double, 3> shape{2, 0.5, 1};  // values of line 7; their meanings depend on the fractal
    int iterations = 1;                      // max iterations of a DE evaluation, 1 to max_iterations
    double escape = 0;                       // second value of line 8
    int colouring = 0;
    double brightness = 1;
    std::string image_file;

    // The following are not in the parameter file, because the original program does not have them.
    bool conservative = false;  // use the fractal's conservative estimate
    bool smooth = false;        // normals ignore details smaller than a tolerance
    bool grainy = false;        // the sky of a look has a noise that hides the steps between bytes
    bool centred = false;       // rays go through the centres of the pixels; false: through their lower left corners
    Projection projection = Projection::perspective;
    Sky sky;
    std::optional<LookValues> look;  // replaces the look of the colouring type
    StepLimits limits;
    CropWindow crop_window;

    bool operator==(const Scene&) const = default;
};

// The entries of a parameter file, in order.
enum class Item { eye, target, up, field_of_view, size, detail, shape, iterations, colouring, brightness, image_file };
inline constexpr int item_count = 11;

// Throws InputError if values are valid individually but not together: the camera is at its target, `up` is parallel to
// the view, or the fractal cannot be computed with these constants. The message begins with where(entry), the place of
// the entry.
void check_scene(const Scene& scene, const std::function<std::string(Item)>& where);

// Returns the sky, turned the shortest way until `up` is its upward direction; its sun is not turned.
Sky turned(const Sky& sky, Vector up);

// Returns the direction of a sun, in degrees `height` above the horizon and `azimuth` to the right of the direction
// `ahead`, which need not be level.
Vector sun_at(const Sky& sky, Vector ahead, double height, double azimuth);

// Returns the look of a scene; nullptr if its colouring is not a look.
const LookValues* look_of(const Scene& scene);

}  // namespace mandelmarch
