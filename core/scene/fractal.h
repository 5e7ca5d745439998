// SPDX-License-Identifier: Apache-2.0
// The registered fractals. Each has a kernel source, core/kernel/fractals/NAME.h, and a descriptor,
// core/scene/fractals/NAME.cpp.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "core/scene/vector.h"

namespace mandelmarch {

struct Scene;
class SceneRandom;
class Formula;

// ParameterInfo and range of a number of a parameter file. The range includes `high`, and `low` unless `open_low`.
struct ParameterInfo {
    std::string_view name;
    double low;
    double high;
    bool open_low = false;
    // Range of a slider that gives interesting pictures, and its step.
    struct Slider {
        double low, high, step;
    };
    std::optional<Slider> slider = std::nullopt;
};

inline constexpr ParameterInfo ignored_number{"a number (ignored)", -1e300, 1e300};
inline constexpr double float_range = 1e37;  // a power of ten below the largest float

// Inputs of a descriptor's formulas. Number is double or Formula (core/scene/formula.h).
template <class Number>
struct FractalInputs {
    std::array<Number, 3> shape;
    Number escape;
    Number iterations;
    Number largest;       // the largest finite power of ten in the picture's precision
    Number conservative;  // 1: conservative estimate, 0: the original one
};

FractalInputs<double> inputs_of(const Scene& scene, double largest = float_range);

// Kernel parameters of a fractal, the same for all pixels.
template <class Number>
struct FractalConstants {
    std::array<Number, 11> values{};
    Number whole = 0;
};

// Two instances of one function template: its value, and its text for use outside the programs.
template <template <class> class Result>
struct RowFormula {
    Result<double> (*value)(const FractalInputs<double>& of);
    Result<Formula> (*text)(const FractalInputs<Formula>& of);
};
template <class Number>
using Plain = Number;

// Parameters of a view that a hull depends on.
struct ViewLimits {
    double slope;     // DE > slope t means no hit
    double distance;  // of the eye from the origin
};

// Bounds of a whole fractal: a cube or a sphere around the origin.
struct Bounds {
    enum class Shape { cube, sphere };
    Shape shape = Shape::sphere;
    double size = 1;  // half the cube's edge, or the sphere's radius

    bool contains(Vector p) const;
};

// Defaults for members that a descriptor does not set.
namespace defaults {
std::string_view objection(const Scene& scene);              // none
double no_hull(const Scene& scene, const ViewLimits& view);  // 0
std::optional<Bounds> unknown_body(const Scene& scene);      // nullopt
template <class Number>
Number step_factor(const FractalInputs<Number>& of);                     // plain_step_factor
double growth(const Scene& scene);                                       // 1: no iteration is known to be invisible
Vector representative(const Scene& scene, Vector p);                     // p
bool worth_searching(const Scene& scene, const Bounds& body, Vector p);  // true
Vector upward(Vector place, Vector up);                                  // away from the origin, as on a planet
void no_tail(const Scene& scene, FractalConstants<double>& constants);   // unchanged
void same_shape(Scene& scene, SceneRandom& chance, bool even);           // unchanged
void same_extreme_shape(Scene& scene, SceneRandom& chance);              // unchanged
inline constexpr std::array iterations{2, 4, 8, 16, 32, 64, 100};
}  // namespace defaults

inline constexpr double sphere_corner = 1;
inline constexpr double cube_corner = 1.7320508075688772;  // sqrt(3)

// The hull: the sphere or cube (as in the kernel source) outside which no ray of a view hits anything.
struct FractalHull {
    double (*size)(const Scene& scene, const ViewLimits& view) = defaults::no_hull;  // 0: no hull
    double corner = cube_corner;  // largest distance from the origin, in units of size
};

// Parameters of fast mode.
struct FractalFast {
    // Step factor. Below plain_step_factor, steps are not over-relaxed: for scenes with thin features, which longer
    // steps would miss.
    RowFormula<Plain> step_factor{defaults::step_factor<double>, defaults::step_factor<Formula>};
    // A canonical hit has |DE - tolerance t| below this fraction of the tolerance. Chosen by the changes of pictures.
    double root_share = 0.001;
    // Cones are used up to this distance of adjacent rays, in tolerances.
    double cone_pitch = 0;
    // Rays begin near the hits of surrounding pixels up to this distance of adjacent rays, in tolerances.
    double neighbour_pitch = 0;
};

// Parameters of planning a tour. Lengths are fractions of the size of the bounds.
struct FlightMeasures {
    double roads = 0.012;        // min clearance of the balls
    double gate_least = 0.0040;  // range of a gate's clearance
    double gate_most = 0.02;
    double pace = 0.19;  // clearances per frame
};

// Thresholds of a flight's audit.
struct FlightBars {
    double step = 0.2;     // clearances per frame
    double aside = 10;     // percent of the frames that look aside
    double passages = 12;  // per 7200 frames
    double planning = 20;  // seconds
};

// Properties of the fractal for planning flights.
struct FractalFlight {
    // Returns the min magnification of an iteration: features of iteration n have about growth^-n of the fractal's
    // size.
    double (*growth)(const Scene& scene) = defaults::growth;
    // Fractions of an estimate. safety: the certainly free part, at some distance from the surface. stride: a step in a
    // close-up, since near the surface an estimate can exceed the distance. `conservative` applies to the conservative
    // estimate, if the fractal has one.
    struct Trust {
        double safety = 0.5;
        double step_factor = 0.5;
    };
    Trust trust{};
    std::optional<Trust> conservative{};
    const Trust& trust_of(const Scene& scene) const;
    // Returns the bounds of the fractal; nullopt: a sphere is found by casting rays.
    std::optional<Bounds> (*body)(const Scene& scene) = defaults::unknown_body;
    // Maps equivalent places of a symmetry to the one in the fundamental region.
    Vector (*representative)(const Scene& scene, Vector p) = defaults::representative;
    // True in a region that includes a fundamental region of the symmetry. Tours are searched only there, to save time.
    bool (*worth_searching)(const Scene& scene, const Bounds& body, Vector p) = defaults::worth_searching;
    // Returns the upward direction of a level camera, a unit vector; `up`: the camera's up vector.
    Vector (*upward)(Vector place, Vector up) = defaults::upward;
    FlightMeasures measures{};
    FlightBars bars{};
};

// Ranges of random scenes (core/scene/random_scene.h and extreme_scene.h). They begin with the official shape.
struct FractalRandom {
    double extent;             // approximate max distance of the fractal from the origin
    double nearest, farthest;  // range of the camera's distance from the origin
    void (*shape)(Scene& scene, SceneRandom& chance, bool even) = defaults::same_shape;
    // Any size and sign that a parameter file allows. Rounded to single precision afterwards.
    void (*extreme_shape)(Scene& scene, SceneRandom& chance) = defaults::same_extreme_shape;
    // Lines 7 and 8 of extreme scenes that keep their shape; nullopt: the official ones.
    std::optional<std::array<double, 4>> plain{};
};

// Parameters of bench.
struct FractalStudy {
    std::span<const int> iterations = defaults::iterations;  // of the study that varies them
    // A view filled by the surface, for the box-vs-bulb study.
    struct CloseUp {
        Vector eye, target, up;
    };
    std::optional<CloseUp> close_up{};
    // Another view of that study: the official one with `added` added to its shape.
    struct Variant {
        std::string_view name;
        std::array<double, 3> added;
    };
    std::optional<Variant> variant{};
    // Allowed percentage of pixels of the official scene that differ visibly between exact mode and the reference
    // backend.
    double off_in_double = 0;
    double off_in_float = 0;
};

struct Fractal {
    std::string_view name;          // stem of its file names
    std::string_view short_name;    // short name on command lines
    int list_order = 1000;          // lists of fractals are sorted by it, then by name
    bool in_default_study = false;  // included in bench by default; the build reads this line, too
    std::string_view official;      // text of the official scene's parameter file
    std::array<ParameterInfo, 3> shape;
    ParameterInfo escape;
    // Returns what is wrong with the three values of line 7 together, or "".
    std::string_view (*objection)(const Scene& scene) = defaults::objection;
    RowFormula<FractalConstants> constants;
    // Sets the constants of tails (the last iterations of an orbit, without tests), a technique of fast mode.
    void (*add_tail)(const Scene& scene, FractalConstants<double>& constants) = defaults::no_tail;
    FractalHull hull{};
    FractalFast fast{};
    FractalFlight flight{};
    FractalRandom random;
    FractalStudy study{};
};

// Sorted by rank, then by name.
std::span<const Fractal> fractals();

// Finds a fractal by name or short name. Throws InputError with the known names.
const Fractal& fractal_named(std::string_view name);

}  // namespace mandelmarch
