// SPDX-License-Identifier: Apache-2.0
#include "core/render/kernel_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "core/render/spacing.h"
#include "core/render/stepping.h"
#include "core/scene/fractal.h"
#include "core/scene/hull.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

// The value of the original program: 2^-26, the square root of double's epsilon.
constexpr double difference_step = 1.4901161193847656e-8;

template <class Layout>
constexpr bool is_float = std::is_same_v<decltype(Layout::tolerance), float>;

// Returns true if the struct has the layout of std430 and OpenCL C: ints, then reals, then triples at multiples of four
// reals.
template <class Layout>
constexpr bool layout_is_portable()
{
    constexpr std::size_t real = sizeof(Layout::tolerance);
    return offsetof(Layout, tolerance) == 32 && offsetof(Layout, fractal) == 32 + 15 * real &&
           offsetof(Layout, look) == 32 + 28 * real && offsetof(Layout, eye) == 32 + 96 * real &&
           sizeof(Layout) == 32 + 132 * real;
}
static_assert(layout_is_portable<layout_f64::Scene>() && layout_is_portable<layout_f32::Scene>());

// The places in core/kernel/looks.h.
static_assert(std::extent_v<decltype(layout_f64::Scene::look)> == kernel_look_numbers);
static_assert(place_in_look("layer_1") == 3 && place_in_look("layer_4") == 27 && place_in_look("sun") == 35 &&
              place_in_look("sky_light") == 38 && place_in_look("ground_light") == 41 &&
              place_in_look("camera_light") == 44 && place_in_look("lamp") == 47 && place_in_look("fill_light") == 50 &&
              place_in_look("zenith") == 53 && place_in_look("horizon") == 56 && place_in_look("glow") == 59 &&
              place_in_look("halo") == 62 && place_in_look("horizon_glow") == 64 && place_in_look("clouds") == 65 &&
              place_in_look("haze") == 66 && place_in_look("exposure") == 67);

// Returns the value of Scene::differences in core/kernel/scene.h. A conservative estimate has no analytic gradient.
int differences(const Scene& scene, bool fast, bool in_float, const Techniques& techniques)
{
    constexpr int gradient = 0;
    constexpr int central = 1;
    constexpr int tetrahedron = 2;
    if (scene.smooth) return tetrahedron;
    if ((!fast || !techniques.gradient) && !in_float) return central;
    return scene.conservative ? tetrahedron : gradient;
}

template <class Triple>
void assign(Triple& to, Vector from)
{
    using Real = decltype(to.x);
    to = {static_cast<std::remove_reference_t<Real>>(from.x), static_cast<std::remove_reference_t<Real>>(from.y),
          static_cast<std::remove_reference_t<Real>>(from.z)};
}

// The range of the scene's columns or rows in the whole picture, which extends from -1 to 1. middle: middle of the
// range, moved by half a pixel if rays go through the centres of pixels. half: half the range's length.
struct Side {
    double middle, half;

    Side(int first, int pixels, int whole, bool centred)
        : middle((2.0 * first + pixels + (centred ? 1 : 0)) / whole - 1), half(static_cast<double>(pixels) / whole)
    {
    }
};

// Sets the camera's position and axes, and for equirectangular pictures the angles.
template <class Layout>
void put_camera(const Scene& scene, Layout& k)
{
    using Real = decltype(Layout::tolerance);
    Camera camera = camera_of(scene);
    const CropWindow& crop_window = scene.crop_window;
    const Side x(crop_window.left, scene.width, crop_window.whole_width > 0 ? crop_window.whole_width : scene.width,
                 scene.centred);
    const Side y(crop_window.bottom, scene.height,
                 crop_window.whole_height > 0 ? crop_window.whole_height : scene.height, scene.centred);
    if (scene.grainy) {
        const auto per_pixel = [](double whole, Vector side) { return whole / (2 * dot(side, side)) * side; };
        // The periods of the noise per pixel to the right and upwards are those of its author.
        assign(k.grain, 0.06711056 * per_pixel(scene.width / x.half, camera.across) +
                            0.00583715 * per_pixel(scene.height / y.half, camera.upward));
    }
    if (scene.projection == Projection::equirectangular) {
        const double longitudes = std::numbers::pi * x.half;
        const double latitudes = std::numbers::pi / 2 * y.half;
        k.longitude = static_cast<Real>(std::numbers::pi * x.middle);
        k.longitudes = static_cast<Real>(longitudes);
        k.latitude = static_cast<Real>(std::numbers::pi / 2 * y.middle);
        k.latitudes = static_cast<Real>(latitudes);
        camera.across = longitudes * unit(camera.across);
        camera.upward = latitudes * unit(camera.upward);
    } else if (scene.centred || crop_window.whole_width > 0) {
        camera = {camera.forward + x.middle * camera.across + y.middle * camera.upward, x.half * camera.across,
                  y.half * camera.upward};
    }
    assign(k.eye, scene.eye);
    assign(k.forward, camera.forward);
    assign(k.across, camera.across);
    assign(k.upward, camera.upward);
    assign(k.sun, scene.sky.sun);
    assign(k.sky_west, cross(scene.sky.up, scene.sky.north));
    assign(k.sky_up, scene.sky.up);
    assign(k.sky_north, scene.sky.north);
}

}  // namespace

Camera camera_of(const Scene& scene)
{
    const double tangent = std::tan(scene.field_of_view * degrees_per_field / 2 * std::numbers::pi / 180);
    const CropWindow& crop_window = scene.crop_window;
    const double aspect = crop_window.whole_width > 0
                              ? static_cast<double>(crop_window.whole_width) / crop_window.whole_height
                              : static_cast<double>(scene.width) / scene.height;
    const Vector forward = unit(scene.target - scene.eye);
    const double up_length = std::hypot(scene.up.x, scene.up.y, scene.up.z);
    const Vector right = unit(cross(forward, (1 / up_length) * scene.up));
    return {forward, (aspect * tangent) * right, tangent * cross(right, forward)};
}

template <class Layout>
Layout kernel_scene(const Scene& scene, Mode mode, const Techniques& techniques)
{
    using Real = decltype(Layout::tolerance);
    const auto real = [](double value) { return static_cast<Real>(value); };
    if (is_float<Layout> && !techniques.gradient) {
        throw InputError("technique gradient: float has no digits for differences, expected double without it");
    }
    const bool fast = mode == Mode::fast;
    FractalConstants<double> constants =
        scene.fractal->constants.value(inputs_of(scene, is_float<Layout> ? float_range : 1e300));
    if (fast && techniques.tail) scene.fractal->add_tail(scene, constants);

    Layout k{};
    k.width = scene.width;
    k.height = scene.height;
    k.max_iterations = scene.iterations;
    k.max_steps = max_steps;
    k.fractal_whole = static_cast<int>(constants.whole);
    k.colouring = scene.colouring;
    k.canonical = fast;
    k.differences = differences(scene, fast, is_float<Layout>, techniques);
    k.tolerance = real(std::pow(10.0, scene.detail));
    const Stepping steps = stepping_of(scene, mode, techniques);
    k.step_factor = real(steps.step_factor);
    k.relaxation = real(steps.relaxation);
    k.root_share = real(steps.root_share);
    k.end = real(farthest_sample);
    k.miss = std::numeric_limits<Real>::infinity();
    k.hull = real(techniques.hull ? hull_size(scene, k.tolerance) : 0);
    k.brightness = real(scene.brightness);
    k.difference_step = real(difference_step);
    for (std::size_t i = 0; i < constants.values.size(); ++i) k.fractal[i] = real(constants.values[i]);
    if (const LookValues* look = look_of(scene)) {
        for (std::size_t i = 0; i < std::size(k.look); ++i) k.look[i] = real(look->numbers.at(i));
    }
    put_camera(scene, k);
    k.spacing = spacing_of(k);
    k.subtile_hull = subtile_hull_of(k, *scene.fractal);
    return k;
}

template layout_f64::Scene kernel_scene(const Scene&, Mode, const Techniques&);
template layout_f32::Scene kernel_scene(const Scene&, Mode, const Techniques&);

}  // namespace mandelmarch
