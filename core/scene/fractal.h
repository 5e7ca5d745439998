// SPDX-License-Identifier: Apache-2.0
// The fractals there are. A fractal is one file of kernel text, core/kernel/fractals/NAME.h, and one row,
// core/scene/fractals/NAME.cpp.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "core/scene/vector.h"

namespace mandelmarch {

struct Scene;
class Chance;
class Formula;

// What one number of a parameter file means, and its range. `low` and `high` are allowed themselves unless `open_low`.
struct Meaning {
    std::string_view name;
    double low;
    double high;
    bool open_low = false;
    // Where pictures are worth looking at: the least and greatest value of a slider, and its step.
    struct Slider {
        double low, high, step;
    };
    std::optional<Slider> slider = std::nullopt;
};

inline constexpr Meaning ignored_number{"a number (ignored)", -1e300, 1e300};
inline constexpr double float_range = 1e37;  // the largest finite power of ten of a float, with room

// What a row's formulas are computed from. Number is double or Formula (core/scene/formula.h).
template <class Number>
struct FractalInputs {
    std::array<Number, 3> shape;
    Number escape;
    Number iterations;
    Number largest;       // the largest finite power of ten of the picture's number type
    Number conservative;  // 1: the estimate is to be the conservative one, 0: the original's
};

FractalInputs<double> inputs_of(const Scene& scene, double largest = float_range);

// What the kernel text of a fractal needs that is the same for all pixels.
template <class Number>
struct FractalConstants {
    std::array<Number, 11> values{};
    Number whole = 0;
};

// The two instances of one function template: its value, and its text for who computes it elsewhere.
template <template <class> class Result>
struct RowFormula {
    Result<double> (*value)(const FractalInputs<double>& of);
    Result<Formula> (*text)(const FractalInputs<Formula>& of);
};
template <class Number>
using Plain = Number;

// What a hull needs to know of a picture.
struct Sight {
    double slope;     // the least DE / t that no surface has: DE > slope t means no hit
    double distance;  // of the eye from the origin
};

// A cube or a sphere about the origin that holds a whole fractal.
struct Hull {
    enum class Shape { cube, sphere };
    Shape shape = Shape::sphere;
    double size = 1;  // half the cube's edge, or the sphere's radius

    bool contains(Vector p) const;
};

// What holds of a fractal whose row says nothing.
namespace usual {
std::string_view objection(const Scene& scene);         // none
double no_hull(const Scene& scene, const Sight& view);  // 0
std::optional<Hull> unknown_body(const Scene& scene);   // nullopt
template <class Number>
Number stride(const FractalInputs<Number>& of);       // plain_stride
double growth(const Scene& scene);                    // 1: no iteration is known to be too fine to be seen
Vector representative(const Scene& scene, Vector p);  // p
bool worth_searching(const Scene& scene, const Hull& body, Vector p);   // true
Vector upward(Vector place, Vector up);                                 // away from the middle, as on a planet
void no_tail(const Scene& scene, FractalConstants<double>& constants);  // leaves them as they are
void same_shape(Scene& scene, Chance& chance, bool even);               // leaves the scene as it is
void same_extreme_shape(Scene& scene, Chance& chance);                  // leaves the scene as it is
inline constexpr std::array iterations{2, 4, 8, 16, 32, 64, 100};
}  // namespace usual

inline constexpr double sphere_corner = 1;
inline constexpr double cube_corner = 1.7320508075688772;  // sqrt(3)

// The sphere or cube (as in the kernel file) outside which no ray of a view hits anything.
struct FractalHull {
    double (*size)(const Scene& scene, const Sight& view) = usual::no_hull;  // 0 where none is proven
    double corner = cube_corner;  // how far it reaches from the origin, in its sizes
};

// What fast mode may do, where it pays.
struct FractalFast {
    // The share of an estimate that a step takes; less than plain_stride, and none is over-relaxed: for scenes whose
    // rays would pass what is thin.
    RowFormula<Plain> stride{usual::stride<double>, usual::stride<Formula>};
    // A canonical hit is where |DE - tolerance t| is below this share of the tolerance: chosen by how far pictures
    // change.
    double root_share = 0.001;
    // Cones of neighbouring rays pay where those are no more than this many tolerances apart.
    double cone_pitch = 0;
    // The hits of pixels around one tell where its ray begins while those are no more than this many tolerances apart.
    double neighbour_pitch = 0;
};

// How a tour is planned. Lengths are shares of the body's size.
struct FlightMeasures {
    double roads = 0.012;        // least clearance of the balls
    double gate_least = 0.0040;  // bounds of a gate's clearance
    double gate_most = 0.02;
    double pace = 0.19;  // clearances a frame
};

// What an audit holds a flight to.
struct FlightBars {
    double step = 0.2;     // clearances a frame
    double aside = 10;     // percent of the frames that look aside
    double passages = 12;  // of 7200 frames
    double planning = 20;  // seconds
};

// What a flight needs to know.
struct FractalFlight {
    // How much one iteration magnifies, at least: features of iteration n are about growth^-n of the fractal's size.
    double (*growth)(const Scene& scene) = usual::growth;
    // The share of an estimate that is surely free some way from the surface, and the share that a step may take in a
    // close-up: near the surface an estimate can be larger than the distance. With the conservative estimate, where the
    // fractal has one of its own, these are `conservative`.
    struct Trust {
        double safety = 0.5;
        double stride = 0.5;
    };
    Trust trust{};
    std::optional<Trust> conservative{};
    const Trust& trust_of(const Scene& scene) const;
    // What holds the fractal; a sphere is found by rays where nothing is known.
    std::optional<Hull> (*body)(const Scene& scene) = usual::unknown_body;
    // Places that a symmetry maps onto each other get the same answer: the one of them in the fundamental region.
    Vector (*representative)(const Scene& scene, Vector p) = usual::representative;
    // True in a region that holds a copy of every place that differs under the symmetry, and some more: where tours are
    // sought, as the rest would only cost time.
    bool (*worth_searching)(const Scene& scene, const Hull& body, Vector p) = usual::worth_searching;
    // The direction, a unit vector, that a level camera at a place shows upwards, where the camera's up vector is `up`.
    Vector (*upward)(Vector place, Vector up) = usual::upward;
    FlightMeasures measures{};
    FlightBars bars{};
};

// How scenes are drawn at random (core/scene/random_scene.h and extreme_scene.h). They begin with the official shape.
struct FractalRandom {
    double extent;             // of the fractal from the origin, about
    double nearest, farthest;  // cameras from the origin
    void (*shape)(Scene& scene, Chance& chance, bool even) = usual::same_shape;
    // Of any size and sign that a parameter file may say. Rounded to single precision afterwards.
    void (*extreme_shape)(Scene& scene, Chance& chance) = usual::same_extreme_shape;
    // Lines 7 and 8 of extreme scenes that keep their shape, where these are not the official ones.
    std::optional<std::array<double, 4>> plain{};
};

// What bench does with it.
struct FractalStudy {
    std::span<const int> iterations = usual::iterations;  // of the study that varies them
    // A view that is all surface, of the box-vs-bulb study.
    struct Look {
        Vector eye, target, up;
    };
    std::optional<Look> close_up{};
    // One more view of that study: the official one but for what is added to its shape.
    struct Variant {
        std::string_view name;
        std::array<double, 3> added;
    };
    std::optional<Variant> variant{};
    // Pixels in a hundred of the official scene by which exact pictures may be visibly off the reference backend's.
    double off_in_double = 0;
    double off_in_float = 0;
};

struct Fractal {
    std::string_view name;      // the stem of its files
    std::string_view nickname;  // short form on command lines
    int rank = 1000;            // lists of fractals go by it, then by name
    bool studied = false;       // bench measures it unless another one is asked for; the build reads this line, too
    std::string_view official;  // the parameter file of the scene that is measured, as text
    std::array<Meaning, 3> shape;
    Meaning escape;
    // What is wrong with the three values of line 7 together, or nothing.
    std::string_view (*objection)(const Scene& scene) = usual::objection;
    RowFormula<FractalConstants> constants;
    // Changes them where an orbit's last iterations may be made without their tests: a technique of fast mode.
    void (*add_tail)(const Scene& scene, FractalConstants<double>& constants) = usual::no_tail;
    FractalHull hull{};
    FractalFast fast{};
    FractalFlight flight{};
    FractalRandom random;
    FractalStudy study{};
};

// In their order.
std::span<const Fractal> fractals();

// By name or nickname. Throws InputError with the known names.
const Fractal& fractal_named(std::string_view name);

}  // namespace mandelmarch
