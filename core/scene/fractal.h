// SPDX-License-Identifier: Apache-2.0
// The fractals there are. A fractal is one file of kernel text, core/kernel/fractals/NAME.h, and one row,
// core/scene/fractals/NAME.cpp.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace mandelmarch {

struct Scene;

// What one number of a parameter file means, and its range. `low` and `high` are allowed themselves unless `open_low`.
struct Meaning {
    std::string_view name;
    double low;
    double high;
    bool open_low = false;
};

inline constexpr Meaning ignored_number{"a number (ignored)", -1e300, 1e300};
inline constexpr double float_range = 1e37;  // the largest finite power of ten of a float, with room

// What the kernel text of a fractal needs that is the same for all pixels, computed in double.
struct FractalConstants {
    std::array<double, 11> values{};
    int whole = 0;
};

// What core/scene/hull.cpp needs to know of a picture.
struct Sight {
    double slope;     // the least DE / t that no surface has: DE > slope t means no hit
    double distance;  // of the eye from the origin
};

// What holds of a fractal whose row says nothing.
namespace usual {
std::string_view objection(const Scene& scene);      // none
double hull(const Scene& scene, const Sight& view);  // 0: none is proven
double stride(const Scene& scene);                   // plain_stride
double growth(const Scene& scene);                   // 1: nothing is known to be too small to be seen
}  // namespace usual

inline constexpr double sphere_corner = 1;
inline constexpr double cube_corner = 1.7320508075688772;  // sqrt(3)

// The sphere or cube (as in the kernel file) outside which no ray of a view hits anything.
struct FractalHull {
    double (*size)(const Scene& scene, const Sight& view) = usual::hull;  // 0 where none is proven
    double corner = cube_corner;  // how far it reaches from the origin, in its sizes
};

// What fast mode may do, where it pays.
struct FractalFast {
    // The share of an estimate that a step takes; less than plain_stride, and none is over-relaxed: for scenes whose
    // rays would pass what is thin.
    double (*stride)(const Scene& scene) = usual::stride;
    // A canonical hit is where |DE - tolerance t| is below this share of the tolerance: chosen by how far pictures
    // change.
    double root_share = 0.001;
    // Cones of neighbouring rays pay where those are no more than this many tolerances apart.
    double cone_pitch = 0;
    // The hits of pixels around one tell where its ray begins while those are no more than this many tolerances apart.
    double neighbour_pitch = 0;
};

// What a flight needs to know.
struct FractalFlight {
    // How much one iteration magnifies, at least: features of iteration n are about growth^-n of the fractal's size.
    double (*growth)(const Scene& scene) = usual::growth;
    // The share of an estimate that is surely free some way from the surface, and the share that a step may take in a
    // close-up: near the surface an estimate can be larger than the distance.
    double safety = 0.5;
    double short_stride = 0.5;
};

struct Fractal {
    std::string_view name;      // the stem of its files
    std::string_view nickname;  // short form on command lines
    int rank = 1000;            // lists of fractals go by it, then by name
    std::array<Meaning, 3> shape;
    Meaning escape;
    // What is wrong with the three values of line 7 together, or nothing.
    std::string_view (*objection)(const Scene& scene) = usual::objection;
    // `largest` is the largest finite power of ten of the number type, as a double. tails: an orbit's last iterations
    // may be made without their tests.
    FractalConstants (*constants)(const Scene& scene, double largest, bool tails);
    FractalHull hull{};
    FractalFast fast{};
    FractalFlight flight{};
};

// In their order.
std::span<const Fractal> fractals();

// By name or nickname. Throws InputError with the known names.
const Fractal& fractal_named(std::string_view name);

}  // namespace mandelmarch
