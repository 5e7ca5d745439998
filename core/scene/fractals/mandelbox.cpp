// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/scene/descriptor.h"
#include "core/scene/scene.h"
#include "core/scene/scene_random.h"

namespace mandelmarch {
namespace {

constexpr std::string_view official =
#include "texts/paramsBox.dat"
    ;
constexpr double huge = 1e6;
constexpr double farthest_point = 1e4;  // exceeds every coordinate of a sample, with a margin
constexpr double slow_growth = 1.8;     // below this scale, more orbits would need a fifth iteration in their tail

// Returns the kernel's unit of length: at this radius, |s| times the factor of the sphere fold is 1.
double unit_of(const Scene& scene) { return std::sqrt(std::abs(scene.shape[0])) * scene.shape[2]; }

std::string_view objection(const Scene& scene)
{
    const auto [scale, inner, fixed] = scene.shape;
    if (scale == 0 || scale == 1) return "scale must not be 0 or 1, expected 2 or -1.5, say";
    const double ratio = fixed / inner;
    if (!(std::abs(scale) * ratio * ratio < float_range))
        return "rMin is too small beside rFixed, expected a larger one";
    const double farthest = std::max({scene.escape, inner, farthest_point}) / unit_of(scene);
    if (!(farthest * farthest < float_range))
        return "rFixed is too small beside the escape time, expected a larger one";
    return {};
}

// Returns the radius at which tails (see Fractal::add_tail) of three or four iterations begin; 0 if there are no tails.
// Outside this radius r, an iteration multiplies r by |s|, except for a change of at most 2 |s| sqrt 3 by the box fold,
// and adds p. The factor 0.96 was found by experiment: with it, nearly all orbits escape in the third or fourth
// iteration of the tail. If r is about twice the fractal's extent, an orbit outside rarely returns to the spheres of
// the sphere fold, because the coordinates of p exceed that extent only a little. tests/unit/techniques_test.cpp counts
// the exceptions.
double tail_radius(const Scene& scene)
{
    const auto [scale, inner, fixed] = scene.shape;
    const double s = std::abs(scale);
    if (s <= 1 || (scale > 0 && scale < slow_growth) || scene.iterations < 6) return 0;
    const double radius = 0.96 * scene.escape / (s * s * s);
    const double edge = scale > 0 ? 2 * (s + 1) / (s - 1) : 2;
    return radius > std::max({1.9 * edge, 2 * inner, 2 * fixed}) ? radius : 0;
}

constexpr std::size_t tail2 = 7;  // index of box_tail2() among the kernel's constants

template <class Number>
FractalConstants<Number> constants(const FractalInputs<Number>& of)
{
    const auto& [scale, inner, fixed] = of.shape;
    const Number s = abs(scale);
    const Number unit = sqrt(s) * fixed;
    const auto square = [&](const Number& length) { return length / unit * (length / unit); };
    return {.values = {s, sign(scale), square(inner), square(max(inner, fixed)), 1 / unit, unit, square(of.escape), 0,
                       abs(scale - 1) / unit, pow(s, 1 - of.iterations)}};
}

void add_tail(const Scene& scene, FractalConstants<double>& to)
{
    const double tail = tail_radius(scene) / unit_of(scene);
    to.values[tail2] = tail * tail;
    to.whole = tail > 0 ? scene.iterations - 4 : 0;
}

double hull(const Scene& scene, const ViewLimits& view)
{
    const auto [scale, inner, fixed] = scene.shape;
    const double s = std::abs(scale);
    if (s <= 1 || inner > fixed) return 0;
    // DE >= share (X - edge) - less - remainder at every point whose largest coordinate is X > edge (docs/hulls.md).
    const double remainder = std::pow(s, 1 - scene.iterations);
    const double edge = scale > 0 ? 2 * (s + 1) / (s - 1) : 2;
    const double share = scale > 0 ? s * (s - 1) / (s * s + s + 1) : 1;
    const double less =
        scale > 0 ? std::max({0.0, (s - 3) / (s + 1), (s - 1 - edge) / (s * s + s + 1)}) : (s - 1) / (s + 1);
    const double slope = share - std::sqrt(3.0) * view.slope;
    if (!(slope > 0)) return 0;
    return (share * edge + less + remainder + view.slope * view.distance) / slope;
}

double growth(const Scene& scene) { return std::abs(scene.shape[0]); }

// Returns a cube; half its edge is 2 (s + 1)/(s - 1) for s > 1, and 2 for s < -1.
std::optional<Bounds> body(const Scene& scene)
{
    const double s = scene.shape[0];
    if (s > 1) return Bounds{Bounds::Shape::cube, 2 * (s + 1) / (s - 1)};
    if (s < -1) return Bounds{Bounds::Shape::cube, 2};
    return {};
}

// Uses the 48 symmetries of a cube.
Vector representative(const Scene&, Vector p)
{
    std::array<double, 3> c{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
    std::ranges::sort(c);
    return {c[0], c[1], c[2]};
}

bool worth_searching(const Scene&, const Bounds& body, Vector p)
{
    return std::min({p.x, p.y, p.z}) > -0.1 * body.size;
}

// Returns the direction of the coordinate axis that is closest to `up`, because floors, walls and ceilings are parallel
// to the sides of the cube.
Vector upward(Vector, Vector up)
{
    const std::array<double, 3> c{std::abs(up.x), std::abs(up.y), std::abs(up.z)};
    const auto most = std::ranges::max_element(c) - c.begin();
    if (most == 0) return {std::copysign(1.0, up.x), 0, 0};
    if (most == 1) return {0, std::copysign(1.0, up.y), 0};
    return {0, 0, std::copysign(1.0, up.z)};
}

// Draws scales above 0 for even scenes, and below 0 for others.
void random_shape(Scene& scene, SceneRandom& chance, bool even)
{
    scene.shape[0] = even ? chance.single_between(1.5, 3) : chance.single_between(-2.5, -1.2);
    scene.shape[1] = chance.single_between(0.2, 0.8);
    scene.shape[2] = chance.single_between(0.8, 1.5);
}

void extreme_shape(Scene& scene, SceneRandom& chance)
{
    const double scale = chance.one_in(4) ? chance.magnitude(1e-2, 20) : chance.between(1.1, 3);
    scene.shape[0] = chance.sign() * scale;
    scene.shape[1] = chance.one_in(4) ? chance.magnitude(1e-4, 1e3) : chance.between(0.1, 1);
    scene.shape[2] = chance.one_in(4) ? chance.magnitude(1e-3, 1e3) : chance.between(0.7, 1.5);
    scene.escape = chance.one_in(3) ? chance.magnitude(1, 1e15) : 100;
}

}  // namespace

constexpr Fractal descriptors::mandelbox{
    .name = "mandelbox",
    .short_name = "box",
    .list_order = 2,
    .official = official,
    .shape = {ParameterInfo{"scale", -huge, huge, false, ParameterInfo::Slider{-3, 4, 0.05}},
              {"rMin", 0, huge, true, ParameterInfo::Slider{0.05, 1, 0.05}},
              {"rFixed", 0, huge, true, ParameterInfo::Slider{0.2, 2, 0.05}}},
    .escape = {"escape time", 0, 1e15, true},
    .objection = objection,
    .constants = {constants<double>, constants<Formula>},
    .add_tail = add_tail,
    .hull = {.size = hull, .corner = cube_corner},
    .fast = {.root_share = 0.003, .cone_pitch = 8, .neighbour_pitch = 35},
    .flight = {.growth = growth,
               .trust = {.safety = 1, .step_factor = plain_step_factor},
               .body = body,
               .representative = representative,
               .worth_searching = worth_searching,
               .upward = upward},
    .random = {.extent = 4, .nearest = 3, .farthest = 14, .shape = random_shape, .extreme_shape = extreme_shape},
};

}  // namespace mandelmarch
