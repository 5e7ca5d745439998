// SPDX-License-Identifier: Apache-2.0
// Frames of films have converged: shorter steps do not change them. They are compared with pictures rendered with short
// steps, and with the solid, which is computed from orbits, without any distance estimate.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/render/kernel_scene.h"
#include "flight/film/convergence.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

struct Place {
    int frame;
    Vector eye, target, up;
};

// Frames of a flight. With the original estimate, pictures of this flight were torn. The first frame is ordinary, and
// the others are close to the poles, where the original estimate is up to forty times too large.
constexpr Place places[] = {
    {300, {0.749212, 0.017614, -0.18735}, {0.622715, 1.00784, -0.246075}, {0.973194, 0.135348, 0.18594}},
    {3300, {0.0984036, -0.0998721, -0.858128}, {-0.558501, 0.431969, -0.323693}, {-0.745286, -0.565327, -0.35349}},
    {5400, {0.328618, 0.412669, 0.784391}, {-0.0173689, 0.772824, 1.65075}, {0.787524, 0.613405, 0.0595037}},
};

// Returns a path of one frame.
Path path_at(const Place& place, bool conservative)
{
    Path path;
    path.scene = official_scene("bulb", 16, 9);
    path.scene.conservative = conservative;
    path.scene.colouring = 3;
    path.frames.push_back({place.eye, place.target, place.up, 1, {}});
    return path;
}

// Returns true if the orbit of p under z -> z^8 + p stays within the radius 4 for this number of iterations.
bool is_solid(Vector p, int iterations)
{
    using Complex = std::complex<double>;
    const auto eighth = [](Complex z) {
        z *= z;
        z *= z;
        return z * z;
    };
    Vector z = p;
    for (int i = 0; i < iterations; ++i) {
        if (dot(z, z) > 16) return false;
        const double rho = std::hypot(z.x, z.y);
        const Complex polar = eighth({z.z, rho});
        const Complex azimuth = rho > 0 ? eighth({z.x / rho, z.y / rho}) : Complex{1, 0};
        z = Vector{polar.imag() * azimuth.real(), polar.imag() * azimuth.imag(), polar.real()} + p;
    }
    return true;
}

// Returns the depth at which a ray from the eye enters the solid, or infinity if it does not. Searches with steps of
// 0.15 tolerances.
double entry(const Scene& scene, Vector direction, double tolerance)
{
    constexpr double begin = 0.003;
    constexpr double end = 4;
    for (double t = begin; t < end; t *= 1 + 0.15 * tolerance) {
        if (is_solid(scene.eye + t * direction, scene.iterations)) return t;
    }
    return std::numeric_limits<double>::infinity();
}

// Returns the fraction of a frame's rays that end more than three tolerances inside the solid.
double share_behind(const Backend& openmp, const Place& place, bool conservative)
{
    const Path path = path_at(place, conservative);
    const Picture picture;
    Scene scene = FrameScenes(path, picture).scene(0);
    const double tolerance = std::pow(10.0, scene.detail);
    scene.width = 14;
    scene.height = 8;
    const Image image = render(openmp, scene, without_trial({.precision = Precision::f32, .mode = Mode::fast}));
    const Camera camera = camera_of(scene);
    int behind = 0;
    for (int j = 0; j < scene.height; ++j) {
        for (int i = 0; i < scene.width; ++i) {
            const double u = (2 * i + 1.0) / scene.width - 1;
            const double v = (2 * j + 1.0) / scene.height - 1;
            const Vector direction = unit(camera.forward + u * camera.across + v * camera.upward);
            const double depth = image.values()[static_cast<std::size_t>(j * scene.width + i)].depth;
            if (depth > entry(scene, direction, tolerance) * (1 + 3 * tolerance)) ++behind;
        }
    }
    return static_cast<double>(behind) / (scene.width * scene.height);
}

TEST(Truth, RaysEndBeforeTheSolid)
{
    const Registry registry = all_backends();
    const Backend& openmp = *registry.find("openmp");
    for (const Place& place : places) EXPECT_LE(share_behind(openmp, place, true), 0.01) << "frame " << place.frame;
    // Negative control: with the original estimate, the first of the torn frames is wrong.
    EXPECT_GT(share_behind(openmp, places[1], false), 0.1);
}

TEST(Truth, FramesAreThoseOfShortSteps)
{
    const Registry registry = all_backends();
    const Backend& openmp = *registry.find("openmp");
    const RendererOptions options{.precision = Precision::f32, .mode = Mode::fast, .counts = false};
    for (const Row& row : truth_rows(path_at(places[1], true), openmp, options, {})) {
        EXPECT_TRUE(row.promise);
        EXPECT_TRUE(row.kept()) << row.name << ": " << row.value;
    }
    // Negative control: the audit of the frame with the original estimate fails.
    const auto torn = truth_rows(path_at(places[1], false), openmp, options, {});
    EXPECT_FALSE(torn.back().kept()) << torn.back().value;
}

// If pixels share the occlusion of their neighbours, rendering is less work, and the picture is nearly the same.
TEST(Film, PixelsOfOneSurfaceShareTheirSurroundings)
{
    const Registry registry = all_backends();
    const Backend& openmp = *registry.find("openmp");
    RendererOptions options = without_trial({.precision = Precision::f32, .mode = Mode::fast});
    const Path path = path_at(places[0], true);
    Scene scene = FrameScenes(path, {}).scene(0);
    scene.crop_window = {.left = 700, .bottom = 400, .whole_width = scene.width, .whole_height = scene.height};
    scene.width = 192;
    scene.height = 108;
    const auto drawn = [&](Image& image) { return openmp.create(options)->render(scene, image).work.de_calls; };
    Image shared(scene.width, scene.height, Image::Layers::bytes);
    Image alone(scene.width, scene.height, Image::Layers::bytes);
    const auto less = drawn(shared);
    options.techniques.shared_occlusion = false;
    const auto more = drawn(alone);
    EXPECT_LT(static_cast<double>(less), 0.85 * static_cast<double>(more));
    const Comparison c = compare(shared, alone);
    EXPECT_GT(c.psnr, 36) << c.psnr;  // root mean square error below 4.1 bytes
    EXPECT_GT(c.differing, 0U);
}

// If rays go through the pixels' centres (`centred`), they are every second ray, in both directions, of a picture of
// twice the size.
TEST(Film, RaysThroughTheCentresAreThoseOfALargerPicture)
{
    const Registry registry = all_backends();
    const Backend& openmp = *registry.find("openmp");
    const Image whole = render(openmp, official_scene("bulb", 60, 40), {});
    Scene scene = official_scene("bulb", 30, 20);
    scene.centred = true;
    const Image middles = render(openmp, scene, {});
    const auto off = [&](int shift) {
        int differing = 0;
        for (int pixel = 0; pixel < 30 * 20; ++pixel) {
            const int at = (shift + 2 * (pixel / 30)) * 60 + shift + 2 * (pixel % 30);
            for (int c = 0; c < 3; ++c) {
                const auto byte = [c](const Image& image, int i) {
                    return image.bytes()[static_cast<std::size_t>(3 * i + c)];
                };
                differing += std::abs(byte(whole, at) - byte(middles, pixel)) > 2;
            }
        }
        return differing;
    };
    EXPECT_LE(off(1), 3);
    EXPECT_GT(off(0), 100);
}

}  // namespace
}  // namespace mandelmarch
