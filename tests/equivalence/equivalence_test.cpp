// SPDX-License-Identifier: Apache-2.0
// Tests all backends, devices, fractals, precisions and modes that are found at run time. In exact mode every bit of
// colour and depth must equal the scalar kernel's. In fast mode at most 2 % of the pixels may differ visibly from the
// canonical picture.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "backends/all.h"
#include "core/base/error.h"
#include "core/scene/fractal.h"
#include "tests/equivalence/equivalence.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_skeleton_backend();  // backends/skeleton

namespace {

std::vector<NamedScene> exact_scenes()
{
    std::vector<NamedScene> scenes = odd_scenes();
    for (NamedScene& scene : random_scenes(4, 20260)) scenes.push_back(std::move(scene));
    for (const Fractal& fractal : fractals()) {
        scenes.push_back({fmt::format("{}, official", fractal.short_name), official_scene(fractal, 161, 107)});
    }
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

class EveryBackend {
public:
    EveryBackend() { fmt::print("{}\n", equivalence_header()); }

    // Checks all devices, fractals, precisions and modes of one backend.
    void check_all(const Backend& backend)
    {
        for (int device = 0; device < static_cast<int>(backend.devices().size()); ++device) {
            for (const Mode mode : {Mode::exact, Mode::fast}) {
                for (const Precision precision : {Precision::f32, Precision::f64}) {
                    for (const Fractal& fractal : fractals()) {
                        check_row(backend, {.device = device, .precision = precision, .mode = mode}, fractal);
                    }
                }
            }
        }
    }

    Registry registry = all_backends();

private:
    void check_row(const Backend& backend, const RendererOptions& options, const Fractal& fractal)
    {
        try {
            const EquivalenceRow row = check(backend, options, std::string(fractal.short_name),
                                             options.mode == Mode::exact ? exact_ : fast_, expected_);
            fmt::print("{}\n", to_text(row));
            EXPECT_TRUE(row.passed()) << to_text(row);
            EXPECT_GT(row.scenes, 0);
        } catch (const Unavailable& error) {
            // Some devices lack a feature, for example double. A backend without any device fails the test
            // EveryBackendOfThisBuildHasADevice.
            fmt::print("{:<10} {:<9} unavailable: {}\n", fractal.short_name, backend.name(), error.what());
        }
    }

    Expected expected_{registry};
    std::vector<NamedScene> exact_ = exact_scenes();
    std::vector<NamedScene> fast_ = fast_scenes();
};

TEST(Equivalence, EveryBackendDrawsTheSamePicture)
{
    EveryBackend every;
    for (const auto& backend : every.registry.backends()) {
        if (const auto why = backend->unavailable()) {
            fmt::print("{:<10} {:<9} unavailable: {}\n", "all", backend->name(), *why);
        } else if (backend->name() != "reference") {
            every.check_all(*backend);
        }
    }
    every.check_all(*make_skeleton_backend());
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
