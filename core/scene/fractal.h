// SPDX-License-Identifier: Apache-2.0
// The fractals there are. A fractal is one file of kernel text, core/kernel/fractals/NAME.h, and one row in
// fractal.cpp.
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

struct Fractal {
    std::string_view name;      // the kernel file's stem, too
    std::string_view nickname;  // short form on command lines
    std::array<Meaning, 3> shape;
    Meaning escape;
    // What is wrong with the three values of line 7 together, or nothing.
    std::string_view (*objection)(const Scene& scene);
    // `largest` is the largest finite power of ten of the number type, as a double. tails: an orbit's last iterations
    // may be made without their tests.
    FractalConstants (*constants)(const Scene& scene, double largest, bool tails);
    // The size of the sphere or cube (as in the kernel file) outside which no ray of this view hits anything; 0 where
    // that is not proven.
    double (*hull)(const Scene& scene, const Sight& view);
    // How far that reaches from the origin, in its sizes.
    double hull_corner;
    // How much one iteration magnifies, at least: features of iteration n are about growth^-n of the fractal's size.
    double (*growth)(const Scene& scene);
    // The share of an estimate that a step of fast mode takes; less than default_stride, and none is over-relaxed:
    // for scenes whose rays would pass what is thin.
    double (*fast_stride)(const Scene& scene);
    // The share of an estimate that is surely free some way from the surface, and the share that a step may take in a
    // close-up: near the surface an estimate can be larger than the distance.
    double safety;
    double short_stride;
    // Cones of neighbouring rays pay where those are no more than this many tolerances apart.
    double cone_pitch;
    // The hits of pixels around one tell where its ray begins while those are no more than this many tolerances apart.
    double lattice_pitch;
    // A canonical hit is where |DE - tolerance t| is below this share of the tolerance: chosen by how far pictures
    // change.
    double root_share;
};

std::span<const Fractal> fractals();

// By name or nickname. Throws InputError with the known names.
const Fractal& fractal_named(std::string_view name);

}  // namespace mandelmarch
