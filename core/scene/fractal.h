// SPDX-License-Identifier: Apache-2.0
// The fractals of this build. Each has a kernel source, core/kernel/fractals/NAME.h, and a descriptor,
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

// Name and range of a number in a parameter file. The range includes `high`. It includes `low` unless `open_low` is
// true.
struct ParameterInfo {
    std::string_view name;
    double low;
    double high;
    bool open_low = false;
    // Range and step of a slider for this number. The range contains values that give interesting pictures.
    struct Slider {
        double low, high, step;
    };
    std::optional<Slider> slider = std::nullopt;
};

inline constexpr ParameterInfo ignored_number{"a number (ignored)", -1e300, 1e300};
inline constexpr double float_range = 1e37;  // a power of ten below the largest float

// The inputs of a descriptor's formulas. Number is double, or Formula (core/scene/formula.h).
template <class Number>
struct FractalInputs {
    std::array<Number, 3> shape;
    Number escape;
    Number iterations;
    Number largest;       // the largest power of ten that is finite in the picture's precision
    Number conservative;  // 1: conservative estimate; 0: original estimate
};

FractalInputs<double> inputs_of(const Scene& scene, double largest = float_range);

// Constants that only the fractal's own kernel source uses. They are the same for all pixels.
template <class Number>
struct FractalConstants {
    std::array<Number, 13> values{};
    Number whole = 0;
};

// A formula of a descriptor, as two instances of one function template: one computes its value, the other returns its
// text, for use outside the programs.
template <template <class> class Result>
struct RowFormula {
    Result<double> (*value)(const FractalInputs<double>& of);
    Result<Formula> (*text)(const FractalInputs<Formula>& of);
};
template <class Number>
using Plain = Number;

// The values of a view that a hull depends on.
struct ViewLimits {
    double slope;     // a sample at t with DE > slope t is not a hit
    double distance;  // distance of the eye from the origin
};

// Bounds of a whole fractal: a cube or a sphere around the origin that contains it.
struct Bounds {
    enum class Shape { cube, sphere };
    Shape shape = Shape::sphere;
    double size = 1;  // half the cube's edge, or the sphere's radius

    bool contains(Vector p) const;
};

// Defaults of the members that a descriptor does not set. The comments give the results.
namespace defaults {
std::string_view objection(const Scene& scene);              // ""
double no_hull(const Scene& scene, const ViewLimits& view);  // 0
std::optional<Bounds> unknown_body(const Scene& scene);      // nullopt
template <class Number>
Number step_factor(const FractalInputs<Number>& of);                     // plain_step_factor
double growth(const Scene& scene);                                       // 1
Vector representative(const Scene& scene, Vector p);                     // p
bool worth_searching(const Scene& scene, const Bounds& body, Vector p);  // true
Vector upward(Vector place, Vector up);                                  // away from the origin; at the origin `up`
void no_tail(const Scene& scene, FractalConstants<double>& constants);   // unchanged
void same_shape(Scene& scene, SceneRandom& chance, bool even);           // unchanged
void same_extreme_shape(Scene& scene, SceneRandom& chance);              // unchanged
}  // namespace defaults

inline constexpr double sphere_corner = 1;
inline constexpr double cube_corner = 1.7320508075688772;  // sqrt(3)

// A fractal's hull: a sphere or cube outside which no ray of a view hits the surface. The kernel source defines which
// of the two it is.
struct FractalHull {
    double (*size)(const Scene& scene, const ViewLimits& view) = defaults::no_hull;  // 0: no hull
    double corner = cube_corner;  // max distance of the hull's points from the origin, in units of its size
};

// A fractal's parameters of fast mode.
struct FractalFast {
    // Step factor. If it is below plain_step_factor, steps are not over-relaxed. Scenes with thin features need such a
    // factor, because longer steps would miss these features.
    RowFormula<Plain> step_factor{defaults::step_factor<double>, defaults::step_factor<Formula>};
    // Refinement of a hit ends if |DE - tolerance t| is below this fraction of the tolerance. The value was chosen by
    // measuring how much pictures change.
    double root_share = 0.001;
    // Cones (bundles of rays that march together) are used if adjacent rays are at most this many tolerances apart.
    double cone_pitch = 0;
    // Rays begin near the hits of surrounding pixels if these pixels' rays are at most this many tolerances apart.
    double neighbour_pitch = 0;
};

// Properties of a fractal for planning flights.
struct FractalFlight {
    // Returns the min magnification of an iteration. Features that iteration n adds have about growth^-n times the
    // fractal's size.
    double (*growth)(const Scene& scene) = defaults::growth;
    // Fractions of the estimate that can be trusted. safety: a sphere around a point, with this fraction of the
    // estimate as its radius, contains no surface, unless the point itself is close to the surface. step_factor: the
    // step factor for films. It can be smaller than `safety`, because close to the surface an estimate can exceed the
    // distance. `conservative` is for the conservative estimate, if the fractal has one.
    struct Trust {
        double safety = 0.5;
        double step_factor = 0.5;
    };
    Trust trust{};
    std::optional<Trust> conservative{};
    const Trust& trust_of(const Scene& scene) const;
    // Returns the bounds of the fractal. If it returns nullopt, flight/field finds a sphere by casting rays.
    std::optional<Bounds> (*body)(const Scene& scene) = defaults::unknown_body;
    // Returns the place in the fundamental region of the fractal's symmetries that is equivalent to p.
    Vector (*representative)(const Scene& scene, Vector p) = defaults::representative;
    // Returns true if p is in the region in which the planner searches routes. To save time, this region is only a part
    // of the bounds, but it includes a fundamental region of the fractal's symmetries.
    bool (*worth_searching)(const Scene& scene, const Bounds& body, Vector p) = defaults::worth_searching;
    // Returns a unit vector, the upward direction of a level camera at `place`. `up` is the camera's up vector.
    Vector (*upward)(Vector place, Vector up) = defaults::upward;
};

// Ranges of random scenes (core/scene/random_scene.h). Both functions change the shape that the
// scene already has.
struct FractalRandom {
    double extent;             // approximate max distance of the fractal from the origin
    double nearest, farthest;  // range of the camera's distance from the origin
    void (*shape)(Scene& scene, SceneRandom& chance, bool even) = defaults::same_shape;
    // Draws values of every size and sign that a parameter file allows. The caller rounds them to single precision.
    void (*extreme_shape)(Scene& scene, SceneRandom& chance) = defaults::same_extreme_shape;
    // Values of lines 7 and 8 for extreme scenes that do not vary them; nullopt: those of the official scene.
    std::optional<std::array<double, 4>> plain{};
};

struct Fractal {
    std::string_view name;        // also the stem of the names of its files
    std::string_view short_name;  // alternative name on command lines
    int list_order = 1000;        // lists of fractals are sorted by this number, then by name
    std::string_view official;    // text of the parameter file of its official scene
    std::array<ParameterInfo, 3> shape;
    ParameterInfo escape;
    // Returns what is wrong with the combination of the three values of the parameter file's line 7, or "" if nothing
    // is.
    std::string_view (*objection)(const Scene& scene) = defaults::objection;
    RowFormula<FractalConstants> constants;
    // Sets the constants of tails. A tail is the last iterations of an orbit, which fast mode computes with only one
    // escape test.
    void (*add_tail)(const Scene& scene, FractalConstants<double>& constants) = defaults::no_tail;
    FractalHull hull{};
    FractalFast fast{};
    FractalFlight flight{};
    FractalRandom random;
};

// Returns the fractals of this build, sorted by list_order, then by name.
std::span<const Fractal> fractals();

// Returns the fractal with this name or short name. Throws InputError, which lists the known names.
const Fractal& fractal_named(std::string_view name);

}  // namespace mandelmarch
