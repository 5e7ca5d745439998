// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/scene/descriptor.h"
#include "core/scene/hull.h"
#include "core/scene/scene.h"
#include "core/scene/scene_random.h"

namespace mandelmarch {
namespace {

constexpr std::string_view official =
#include "texts/paramsJulia.dat"
    ;

constexpr ParameterInfo::Slider part{-1, 1, 0.005};

// A larger escape radius makes the estimate more accurate; with 1000, r^2 of an escaped point still fits in a float.
constexpr double escape_radius = 1000;

// The quaternion c consists of the three values of `shape` and, as its k part, `escape`.
template <class Number>
FractalConstants<Number> constants(const FractalInputs<Number>& of)
{
    const auto& [a, i, j] = of.shape;
    return {.values = {a, i, j, of.escape, escape_radius * escape_radius}};
}

double hull(const Scene& scene, const ViewLimits& view)
{
    const auto [a, i, j] = scene.shape;
    const double c = std::sqrt(a * a + i * i + j * j + scene.escape * scene.escape);
    const auto bound = [&](double r) { return least_estimate(r, 2, 1, c, 0, escape_radius, scene.iterations); };
    return radius_where(bound, 0.5 * (1 + std::sqrt(1 + 4 * c)), view);
}

// The surface is typically at |z| = 1, where z^2 doubles lengths.
double growth(const Scene&) { return 2; }

void random_shape(Scene& scene, SceneRandom& chance, bool)
{
    scene.shape[0] = chance.single_between(-0.6, 0.2);
    scene.shape[1] = chance.single_between(-0.6, 0.6);
    scene.shape[2] = chance.single_between(-0.4, 0.4);
    scene.escape = chance.single_between(-0.5, 0.5);
}

void extreme_shape(Scene& scene, SceneRandom& chance)
{
    const double most = chance.one_in(4) ? 4 : 0.7;
    for (double& value : scene.shape) value = chance.one_in(8) ? 0 : chance.between(-most, most);
    scene.escape = chance.between(-most, most);
}

}  // namespace

constexpr Fractal descriptors::julia{
    .name = "julia",
    .short_name = "julia",
    .list_order = 3,
    .official = official,
    .shape = {ParameterInfo{"c's real part", -4, 4, false, part},
              {"c's i part", -4, 4, false, part},
              {"c's j part", -4, 4, false, part}},
    .escape = {"c's k part", -4, 4, false, part},
    .constants = {constants<double>, constants<Formula>},
    .hull = {.size = hull, .corner = sphere_corner},
    .fast = {.root_share = 0.01, .cone_pitch = 40, .neighbour_pitch = 48},
    .flight = {.growth = growth, .trust = {.safety = 1, .step_factor = plain_step_factor}},
    .random = {.extent = 1.2,
               .nearest = 1.1,
               .farthest = 2.5,
               .shape = random_shape,
               .extreme_shape = extreme_shape,
               .plain = std::array{-0.25, 0.375, 0.125, 0.0}},
};

}  // namespace mandelmarch
