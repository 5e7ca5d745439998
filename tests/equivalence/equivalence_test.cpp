// Every backend x device x fractal x precision x mode that is found at run time. In exact mode every bit of colour and
// depth is that of the text as scalar C++; in fast mode the picture is the canonical one, as far as an eye can see.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "backends/all.h"
#include "core/base/error.h"
#include "core/scene/fractal.h"
#include "tests/equivalence/equivalence.h"

namespace mandelmarch {
namespace {

std::vector<NamedScene> exact_scenes()
{
    std::vector<NamedScene> scenes = odd_scenes();
    for (NamedScene& scene : random_scenes(4, 20260)) scenes.push_back(std::move(scene));
    for (const char* name : {"bulb", "box", "julia"}) {
        scenes.push_back({fmt::format("{}, official", name), official_scene(name, 161, 107)});
    }
    return scenes;
}

std::vector<NamedScene> fast_scenes()
{
    std::vector<NamedScene> scenes;
    for (const char* name : {"bulb", "box", "julia"}) {
        scenes.push_back({fmt::format("{}, fast", name), official_scene(name, 240, 240)});
    }
    return scenes;
}

// The devices of a machine in CI are on its CPU; a backend of this build that finds none has lost its driver.
TEST(Equivalence, EveryBackendOfThisBuildHasADevice)
{
    const Registry registry = all_backends();
    std::istringstream built(MANDELMARCH_BUILT_BACKENDS);
    int count = 0;
    for (std::string name; built >> name; ++count) {
        const Backend* backend = registry.find(name);
        ASSERT_NE(backend, nullptr) << name;
        EXPECT_EQ(backend->unavailable(), std::nullopt) << name;
        EXPECT_FALSE(backend->devices().empty()) << name;
    }
    EXPECT_GE(count, 2);
}

TEST(Equivalence, EveryBackendDrawsTheSamePicture)
{
    const Registry registry = all_backends();
    Expected expected(registry);
    const auto exact = exact_scenes();
    const auto fast = fast_scenes();
    fmt::print("{}\n", equivalence_header());
    for (const auto& backend : registry.backends()) {
        if (backend->name() == "reference" || backend->unavailable()) continue;
        const int devices = static_cast<int>(backend->devices().size());
        for (int device = 0; device < devices; ++device) {
            for (const Mode mode : {Mode::exact, Mode::fast}) {
                for (const Precision precision : {Precision::f32, Precision::f64}) {
                    for (const Fractal& fractal : fractals()) {
                        EquivalenceRow row;
                        try {
                            row = check(*backend, {.device = device, .precision = precision, .mode = mode},
                                        std::string(fractal.nickname), mode == Mode::exact ? exact : fast, expected);
                        } catch (const Unavailable& error) {
                            fmt::print("{:<10} {:<9} unavailable: {}\n", fractal.nickname, backend->name(),
                                       error.what());
                            continue;
                        }
                        fmt::print("{}\n", to_text(row));
                        EXPECT_TRUE(row.fine()) << to_text(row);
                        EXPECT_GT(row.scenes, 0);
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace mandelmarch
