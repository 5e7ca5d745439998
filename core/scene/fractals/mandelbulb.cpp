// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scene/descriptor.h"
#include "core/scene/hull.h"
#include "core/scene/scene.h"
#include "core/scene/scene_random.h"

namespace mandelmarch {
namespace {

constexpr std::string_view official =
#include "texts/paramsBulb.dat"
    ;
constexpr double low_power_stride = 0.4;
// Fraction c of the envelope in conservative_growth() (core/kernel/fractals/mandelbulb.h).
// docs/notes/experiments.md explains the value.
constexpr double envelope_share = 0.7;

// The bailout radius is limited so that r^3P is finite, because gradients contain products of r^P and its derivative.
template <class Number>
FractalConstants<Number> constants(const FractalInputs<Number>& of)
{
    const Number& power = of.shape[2];
    return {.values = {min(of.shape[1], pow(of.largest, 1 / (3 * power))), power, envelope_share * of.conservative},
            .whole = pick(power == floor(power), power, 0)};
}

double hull(const Scene& scene, const ViewLimits& view)
{
    const double escape = scene.shape[1];
    const double power = scene.shape[2];
    if (power <= 1) return 0;
    // The estimator does not compute the radius after the last iteration, so the orbit must escape one iteration
    // earlier.
    const double stretch = scene.conservative ? std::max(1.0, envelope_share * power) : 1;
    const auto bound = [&](double r) { return least_estimate(r, power, stretch, r, 1, escape, scene.iterations - 1); };
    return radius_where(bound, std::pow(2, 1 / (power - 1)), view);
}

// Steps are shorter at low powers, where longer steps miss thin features (docs/notes/experiments.md).
template <class Number>
Number step_factor(const FractalInputs<Number>& of)
{
    return pick(of.shape[2] < 4.5, low_power_stride, plain_step_factor);
}

double growth(const Scene& scene) { return scene.shape[2]; }

bool has_whole_power(const Scene& scene)
{
    const double power = scene.shape[2];
    return power == std::floor(power) && power >= 2;
}

// Returns a sphere of radius 2^(1/(P - 1)).
std::optional<Bounds> body(const Scene& scene)
{
    if (!(scene.shape[2] > 1.2F)) return {};  // shapes have single precision
    return Bounds{Bounds::Shape::sphere, std::pow(2, 1 / (scene.shape[2] - 1))};
}

// The fractal is symmetric under y -> -y. If P is an integer, it has a (P - 1)-fold rotation symmetry about the z axis;
// if P is also odd, it is symmetric under z -> -z, too.
Vector representative(const Scene& scene, Vector p)
{
    const double power = scene.shape[2];
    const bool whole = has_whole_power(scene);
    double angle = std::abs(std::atan2(p.y, p.x));
    if (whole) {
        const double turn = 2 * std::numbers::pi / (power - 1);
        angle = std::abs(angle - turn * std::round(angle / turn));
    }
    const double rho = std::hypot(p.x, p.y);
    const bool odd = whole && std::fmod(power, 2) == 1;
    return {rho * std::cos(angle), rho * std::sin(angle), odd ? std::abs(p.z) : p.z};
}

bool worth_searching(const Scene& scene, const Bounds&, Vector p)
{
    const double turns = scene.shape[2] - 1;
    const double wedge = has_whole_power(scene) ? 2.1 * std::numbers::pi / turns : 1.1 * std::numbers::pi;
    return std::abs(std::atan2(p.y, p.x)) < wedge;
}

// Draws integer powers for even scenes, and any powers for others.
void random_shape(Scene& scene, SceneRandom& chance, bool even)
{
    scene.shape[1] = chance.single_between(2, 6);
    scene.shape[2] = even ? std::floor(chance.between(2, 12)) : chance.single_between(2, 12);
}

void extreme_shape(Scene& scene, SceneRandom& chance)
{
    scene.shape[1] = chance.one_in(4) ? chance.magnitude(1e-3, 1e6) : chance.between(1.2, 6);
    const double power = chance.one_in(5) ? chance.magnitude(0.01, 1000) : chance.between(1, 12);
    scene.shape[2] = chance.one_in(3) ? 8 : chance.one_in(2) ? std::max(1.0, std::floor(power)) : power;
}

}  // namespace

constexpr Fractal descriptors::mandelbulb{
    .name = "mandelbulb",
    .short_name = "bulb",
    .list_order = 1,
    .official = official,
    .shape = {ignored_number,
              {"bailout", 0, 1e6, true, ParameterInfo::Slider{1.5, 16, 0.5}},
              {"power", 0, 1000, true, ParameterInfo::Slider{2, 16, 0.1}}},
    .escape = ignored_number,
    .constants = {constants<double>, constants<Formula>},
    .hull = {.size = hull, .corner = sphere_corner},
    .fast = {.step_factor = {step_factor<double>, step_factor<Formula>},
             .root_share = 0.02,
             .cone_pitch = 40,
             .neighbour_pitch = 48},
    .flight = {.growth = growth,
               .trust = {.safety = 0.8, .step_factor = 0.6},
               .conservative = FractalFlight::Trust{.safety = 0.9, .step_factor = 0.9},
               .body = body,
               .representative = representative,
               .worth_searching = worth_searching},
    .random = {.extent = 1.2, .nearest = 1.1, .farthest = 2.5, .shape = random_shape, .extreme_shape = extreme_shape},
};

}  // namespace mandelmarch
