// SPDX-License-Identifier: Apache-2.0
// Tests all backends, devices, fractals, precisions and modes that are found at run time. In exact mode every bit of
// colour and depth must equal the scalar kernel's. In fast mode at most 2 % of the pixels may differ visibly from the
// canonical picture.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "backends/all.h"
#include "bench/fidelity/equivalence.h"
#include "core/image/compare.h"
#include "core/render/expected.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_skeleton_backend();  // backends/skeleton

namespace {

// Returns a scene whose eye is inside the solid. Every DE evaluation takes all iterations. Therefore even a pass of one
// step has more loop iterations than lavapipe allows.
Scene long_estimates()
{
    Scene scene = official_scene("bulb", 24, 18);
    scene.eye = {0.001, 0.002, 0.001};
    scene.shape[1] = 1e6;
    scene.shape[2] = 1;
    scene.iterations = 10'000;
    scene.escape = 0;
    return scene;
}

// The sizes include single pixels, rows and columns, and sizes that are not multiples of a block, a strip or a work
// group. Pictures of several bands take long, and are of one fractal.
std::vector<NamedScene> exact_scenes()
{
    std::vector<NamedScene> scenes = odd_scenes();
    for (NamedScene& scene : random_scenes(4, 20260)) scenes.push_back(std::move(scene));
    const auto add = [&](const Fractal& fractal, int width, int height) {
        scenes.push_back(
            {fmt::format("{}, {} x {}", fractal.short_name, width, height), official_scene(fractal, width, height)});
    };
    for (const Fractal& fractal : fractals()) {
        for (const auto& [width, height] : {std::pair(161, 107), {1, 1}, {3, 2}, {1, 201}, {301, 37}}) {
            add(fractal, width, height);
        }
        if (fractal.short_name == "bulb") scenes.push_back({"ten thousand iterations", long_estimates()});
    }
    add(fractals().front(), 400, 390);
    add(fractals().front(), 20000, 2);
    return scenes;
}

std::vector<NamedScene> fast_scenes()
{
    std::vector<NamedScene> scenes;
    for (const Fractal& fractal : fractals()) {
        scenes.push_back({fmt::format("{}, fast", fractal.short_name), official_scene(fractal, 160, 160)});
    }
    return scenes;
}

// On CI machines every backend must have a device, which is at least the CPU. If a backend of this build has no device,
// its driver is missing.
TEST(Equivalence, EveryBackendOfThisBuildHasADevice)
{
    Registry registry = all_backends();
    std::istringstream built(MANDELMARCH_BUILT_BACKENDS);
    int count = 0;
    for (std::string name; built >> name; ++count) {
        const Backend* backend = registry.find(name);
        if (backend == nullptr) {  // it only makes others, and refuses an empty argument
            EXPECT_THROW(registry.open(name + ":"), InputError) << name;
            continue;
        }
        EXPECT_EQ(backend->unavailable(), std::nullopt) << name;
        EXPECT_FALSE(backend->devices().empty()) << name;
    }
    EXPECT_GE(count, 2);
}

// Checks all devices and precisions of the backends, all if no names are given, in both modes.
void check_all(const Registry& registry, const std::vector<std::string>& names)
{
    for (const Mode mode : {Mode::exact, Mode::fast}) {
        const std::vector<NamedScene> scenes = mode == Mode::exact ? exact_scenes() : fast_scenes();
        const auto result = bench::compare_backends(
            registry, {.backends = names, .mode = mode, .others = scenes}, [](const bench::Discrepancy& d) {
                ADD_FAILURE() << d.scene << ": " << d.subject << ": " << d.what << "\n" << d.parameters;
            });
        fmt::print("{}\n{}", name_of(mode), to_console(result));
        EXPECT_TRUE(result.failures.empty());
        for (const bench::Tested& tested : result.subjects) {
            // Some devices lack a feature, for example double. A backend without any device fails the test
            // EveryBackendOfThisBuildHasADevice.
            EXPECT_EQ(tested.pictures + tested.unavailable, std::ssize(scenes)) << tested.name();
        }
    }
}

TEST(Equivalence, EveryBackendDrawsTheSamePicture)
{
    check_all(all_backends(), {});
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_reference_backend());
    backends.push_back(make_openmp_backend());
    backends.push_back(make_skeleton_backend());
    check_all(Registry(std::move(backends)), {"skeleton"});
}

// Julia is such a fractal. Negative control: the reference draws the Mandelbox, with all techniques.
TEST(Equivalence, PicturesThatTheReferenceCannotDrawAreExpectedWithoutCones)
{
    const Registry registry = all_backends();
    for (const Fractal& fractal : fractals()) {
        const Scene scene = official_scene(fractal, 16, 16);
        const ExpectedBy by = expected_by(registry, scene, Precision::f32, Mode::fast);
        const bool drawn = registry.with(Role::reference).draws(scene);
        EXPECT_EQ(by.backend->info().role, drawn ? Role::reference : Role::host) << fractal.name;
        EXPECT_EQ(by.options.techniques.cones, drawn) << fractal.name;
        EXPECT_EQ(by.options.techniques.neighbours, drawn) << fractal.name;
    }
}

// Returns the work of a fast picture in float. A trial precedes the picture, so that the device's buffers are not new.
Work work_of(const Backend& backend, const Scene& scene, const Techniques& techniques)
{
    const auto renderer =
        backend.create({.precision = Precision::f32, .mode = Mode::fast, .counts = true, .techniques = techniques});
    Image image(scene.width, scene.height, Image::Layers::all);
    return renderer->render(scene, image).work;
}

// Every backend but the reference has cones, and some have neighbours. Negative control: the official Mandelbox is too
// coarse for both, so its rays take the same steps with and without them.
TEST(Equivalence, ConesAndNeighboursSaveSteps)
{
    const Registry registry = all_backends();
    const Techniques neither{.cones = false, .neighbours = false};
    for (const auto& backend : registry.backends()) {
        if (backend->unavailable() || backend->info().role == Role::reference) continue;
        for (const Fractal& fractal : fractals()) {
            const bool saves = fractal.short_name == "bulb";
            if (!saves && fractal.short_name != "box") continue;
            const Scene scene = official_scene(fractal, saves ? 640 : 120, saves ? 640 : 120);
            const Work with = work_of(*backend, scene, {});
            const Work without = work_of(*backend, scene, neither);
            // Cones have DE evaluations and iterations of their own, but no steps.
            for (const auto count : {&Work::steps, &Work::de_calls, &Work::iterations}) {
                const double share = static_cast<double>(with.*count) / static_cast<double>(without.*count);
                EXPECT_TRUE(saves ? share > 0.3 && share < 0.85 : share == 1)
                    << backend->name() << " " << fractal.name << ": " << share;
            }
        }
    }
}

// OpenCL's vectors give the bits of the scalar kernel and do the same work. In fast mode, in which they begin rays at
// cones and neighbours, pictures are the scalar kernel's up to 1 % of the pixels and of the steps.
TEST(Equivalence, VectorsOfEveryWidthDrawTheScalarPicture)
{
    const Registry registry = all_backends();
    const auto drawn = [](const Backend& backend, const RendererOptions& options, const Scene& scene) {
        Image image(scene.width, scene.height, Image::Layers::all);
        const Work work = backend.create(options)->render(scene, image).work;
        return std::pair(std::move(image), work);
    };
    Scene scene = official_scene(fractals().front(), 301, 93);
    scene.detail = -2;  // a coarse tolerance, so that small pictures have neighbours
    for (const auto& backend : registry.backends()) {
        const BackendInfo info = backend->info();
        if (!info.simd_width || info.role == Role::host || backend->unavailable()) continue;
        for (RendererOptions options : {RendererOptions{.precision = Precision::f64, .simd_width = 1},
                                        {.precision = Precision::f64, .simd_width = 4},
                                        {.precision = Precision::f32, .simd_width = 1},
                                        {.precision = Precision::f32, .simd_width = 4},
                                        {.precision = Precision::f64, .mode = Mode::fast, .simd_width = 2},
                                        {.precision = Precision::f64, .mode = Mode::fast, .simd_width = 8},
                                        {.precision = Precision::f32, .mode = Mode::fast, .simd_width = 4},
                                        {.precision = Precision::f32, .mode = Mode::fast, .simd_width = 32}}) {
            const auto [image, work] = drawn(*backend, options, scene);
            SCOPED_TRACE(fmt::format("{}, SIMD width {}", name_of(options.precision), options.simd_width));
            options.simd_width = 1;
            const auto [expected, scalar] = drawn(registry.with(Role::host), options, scene);
            const Comparison difference = compare(expected, image);
            if (options.mode == Mode::exact) {
                EXPECT_TRUE(difference.same());
                EXPECT_EQ(work.de_calls, scalar.de_calls);
            }
            EXPECT_LE(100 * difference.visibly_differing, difference.pixels);
            const double steps = static_cast<double>(scalar.steps);
            EXPECT_NEAR(static_cast<double>(work.steps), steps, 0.01 * steps);
        }
    }
}

// Backends copy a picture that has only bytes from a device in another way than a picture with values. With these sizes
// the last word and the last work group are only partly filled.
TEST(Equivalence, BytesAloneAreThoseOfTheValues)
{
    const Registry registry = all_backends();
    for (const auto& backend : registry.backends()) {
        if (backend->unavailable() || backend->info().role == Role::reference) continue;
        const auto renderer = backend->create({.precision = Precision::f32, .counts = false});
        const auto bytes = [&](const Scene& scene, Image::Layers layers) {
            Image image(scene.width, scene.height, layers);
            renderer->render(scene, image);
            return std::vector<std::uint8_t>(image.bytes().begin(), image.bytes().end());
        };
        for (const Fractal& fractal : fractals()) {
            const Scene scene = official_scene(fractal, 51, 37);
            const std::vector<std::uint8_t> expected = bytes(scene, Image::Layers::all);
            EXPECT_EQ(bytes(scene, Image::Layers::bytes), expected) << backend->name() << " " << fractal.short_name;
            // Negative control: other bytes are detected.
            Scene other = scene;
            other.brightness *= 0.5;
            EXPECT_NE(bytes(other, Image::Layers::bytes), expected) << backend->name() << " " << fractal.short_name;
        }
    }
}

}  // namespace
}  // namespace mandelmarch
