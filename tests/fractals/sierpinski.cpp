// SPDX-License-Identifier: Apache-2.0
#include "core/scene/descriptor.h"
#include "core/scene/scene.h"
#include "core/scene/scene_random.h"

namespace mandelmarch {
namespace {

constexpr std::string_view official = R"dat(# Sierpinski's tetrahedron
1.9 1.3 2.6
0 0 0
0 1 0
1
400 300
-3
# scale; two numbers that are ignored
2 0 0
# iterations, escape radius
12 8
1
1.2
sierpinski.bmp
)dat";

constexpr double radius = 1.7320508075688772;  // sqrt(3); of the sphere through the corners (1, 1, 1), (1, -1, -1), ...

template <class Number>
FractalConstants<Number> constants(const FractalInputs<Number>& of)
{
    const Number& scale = of.shape[0];
    return {.values = {scale, scale - 1, of.escape * of.escape, radius}};
}

// After an iteration |z| is at least s |z| - (s - 1) radius. Therefore the estimate is at least |p| - radius.
double hull(const Scene&, const ViewLimits& view)
{
    return view.slope < 1 ? (radius + view.slope * view.distance) / (1 - view.slope) : 0;
}

std::optional<Bounds> body(const Scene&) { return Bounds{Bounds::Shape::sphere, radius}; }

double growth(const Scene& scene) { return scene.shape[0]; }

// With larger scales the fractal is dust, and the places at which rays hit it depend on the lengths of their steps.
void random_shape(Scene& scene, SceneRandom& chance, bool) { scene.shape[0] = chance.single_between(1.3, 1.6); }

void extreme_shape(Scene& scene, SceneRandom& chance)
{
    scene.shape[0] = chance.one_in(4) ? chance.magnitude(1.001, 4) : chance.between(1.5, 2.5);
    scene.escape = chance.one_in(3) ? chance.magnitude(2, 1e6) : 8;
}

}  // namespace

constexpr Fractal descriptors::sierpinski{
    .name = "sierpinski",
    .short_name = "tetra",
    .official = official,
    .shape = {ParameterInfo{"scale", 1, 4, true}, ignored_number, ignored_number},
    .escape = {"escape radius", 2, 1e6},
    .constants = {constants<double>, constants<Formula>},
    .hull = {.size = hull, .corner = sphere_corner},
    .flight = {.growth = growth, .trust = {.safety = 1, .step_factor = plain_step_factor}, .body = body},
    .random = {.extent = 1.7, .nearest = 2, .farthest = 4, .shape = random_shape, .extreme_shape = extreme_shape},
};

}  // namespace mandelmarch
