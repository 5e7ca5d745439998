// SPDX-License-Identifier: Apache-2.0
// Exact mode gives the same bits for any number of threads and any instruction set; tests/equivalence tests the pack
// widths. The negative control is the test OneBitOfColourOrDepthIsFound.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

// Expects that both pictures have the same bits. `what`: name of the picture in messages.
void expect_same_bits(const Image& expected, const Image& image, const std::string& what)
{
    const Comparison difference = compare(expected, image);
    EXPECT_TRUE(difference.same()) << what << ": "
                                   << describe_pixel(expected, image, std::max<std::int64_t>(0, difference.first));
}

class SameBits : public testing::TestWithParam<Precision> {
protected:
    const Registry registry = all_backends();
    const Backend& openmp = *registry.find("openmp");

    Image draw(const Scene& scene, int threads, int simd_width, Mode mode = Mode::exact) const
    {
        return render(openmp, scene,
                      {.precision = GetParam(), .mode = mode, .threads = threads, .simd_width = simd_width});
    }

    static std::vector<NamedScene> scenes()
    {
        std::vector<NamedScene> all = odd_scenes();
        all.push_back({"bulb", official_scene("bulb", 333, 217)});
        all.push_back({"box", official_scene("box", 333, 217)});
        return all;
    }
};

TEST_P(SameBits, ThreadsDoNotChangeABit)
{
    for (const Mode mode : {Mode::exact, Mode::fast}) {
        for (const auto& [name, scene] : scenes()) {
            expect_same_bits(draw(scene, 1, 0, mode), draw(scene, 7, 0, mode),
                             fmt::format("{} {}", name, name_of(mode)));
        }
    }
}

// With several threads, a ray shares its pack with other rays in each picture. If a compiler fused operations in one
// SIMD vector of a pack but not in another, about one ray in a million would change.
TEST_P(SameBits, ThreadsDoNotChangeAMillionFastRays)
{
    const Scene scene = official_scene("box", 1080, 1080);
    const Image first = draw(scene, 1, 0, Mode::fast);
    for (const int threads : {2, 3, 2, 3, 2, 3}) {
        expect_same_bits(first, draw(scene, threads, 0, Mode::fast), fmt::format("{} threads", threads));
    }
}

// A picture that has only bytes is stored by other code than a picture with all layers. Both must have the same bytes.
TEST_P(SameBits, BytesAloneAreThoseOfAllLayers)
{
    for (const int simd_width : {0, 1}) {
        for (const auto& [name, scene] : scenes()) {
            const RendererOptions options{.precision = GetParam(), .mode = Mode::fast, .simd_width = simd_width};
            Image bytes(scene.width, scene.height, Image::Layers::bytes);
            Image all(scene.width, scene.height, Image::Layers::all);
            const Work work = openmp.create(options)->render(scene, bytes).work;
            const Work whole = openmp.create(options)->render(scene, all).work;
            EXPECT_EQ(bytes.bytes(), all.bytes()) << name << ", SIMD width " << simd_width;
            EXPECT_GE(work.de_calls, bytes.pixels() / 100);
            EXPECT_EQ(work.de_calls, whole.de_calls) << name;
            EXPECT_EQ(work.steps, whole.steps) << name;
            EXPECT_EQ(work.iterations, whole.iterations) << name;
            // If counting is off, the reported work may be 0, but the picture must be the same.
            RendererOptions uncounted = options;
            uncounted.counts = false;
            Image again(scene.width, scene.height, Image::Layers::bytes);
            const Work none = openmp.create(uncounted)->render(scene, again).work;
            EXPECT_EQ(bytes.bytes(), again.bytes()) << name << ", SIMD width " << simd_width << ", uncounted";
            EXPECT_TRUE(none.de_calls == 0 || none.de_calls == whole.de_calls) << name;
            // Sanitizer builds have no variant without counts.
            if (simd_width == 0) {
                EXPECT_EQ(none.de_calls == 0, !MANDELMARCH_SANITIZED) << name;
            }
        }
    }
}

// The packs of every instruction set that this machine has must give the same bits.
TEST_P(SameBits, InstructionSetDoesNotChangeABit)
{
    std::set<std::string> ran;
    for (const char* name : {"SCALAR", "EMU128", "SSE2", "SSE4", "AVX2", "AVX-512"}) {
        ASSERT_EQ(setenv("MANDELMARCH_INSTRUCTIONS", name, 1), 0);
        for (const auto& [scene_name, scene] : scenes()) {
            Image packed(scene.width, scene.height, Image::Layers::all);
            try {
                ran.insert(openmp.create({.precision = GetParam()})->render(scene, packed).instruction_set);
            } catch (const InputError&) {
                break;  // the machine lacks these instructions
            }
            expect_same_bits(draw(scene, 2, 1), packed, fmt::format("{}, {}", scene_name, name));
        }
    }
    unsetenv("MANDELMARCH_INSTRUCTIONS");
    // Builds for this machine and sanitizer builds have one instruction set (cmake/InstructionSets.cmake).
    EXPECT_TRUE(MANDELMARCH_ONE_INSTRUCTION_SET || ran.contains("SSE4"));
    EXPECT_TRUE(ran.contains("scalar"));
    Image image(8, 8, Image::Layers::bytes);
    const Scene scene = official_scene("bulb", 8, 8);
    EXPECT_TRUE(ran.contains(openmp.create({.precision = GetParam()})->render(scene, image).instruction_set));
}

// AVX-512 can be selected by its usual name and by Highway's, AVX3, and is reported by its usual name. An empty name
// selects nothing.
TEST(Instructions, HaveTheirUsualNames)
{
    const Registry registry = all_backends();
    const Scene scene = official_scene("box", 16, 16);
    const auto ran = [&](const char* name) -> std::string {
        EXPECT_EQ(setenv("MANDELMARCH_INSTRUCTIONS", name, 1), 0);
        Image image(scene.width, scene.height, Image::Layers::bytes);
        try {
            return registry.find("openmp")->create({})->render(scene, image).instruction_set;
        } catch (const InputError&) {
            return "refused";
        }
    };
    EXPECT_EQ(ran("AVX3"), ran("AVX-512"));
    EXPECT_TRUE(ran("AVX3") == "AVX-512" || ran("AVX3") == "refused") << ran("AVX3");
    EXPECT_NE(ran(""), "refused");
    EXPECT_EQ(ran("AVX"), "refused");
    unsetenv("MANDELMARCH_INSTRUCTIONS");
}

// Negative control: the comparison detects a single bit.
TEST_P(SameBits, OneBitOfColourOrDepthIsFound)
{
    const Scene scene = official_scene("box", 64, 64);
    const Image image = draw(scene, 1, 1);
    Image colour = image;
    colour.values()[1234].green = std::nextafter(colour.values()[1234].green, 2.0);
    EXPECT_EQ(compare(image, colour).first, 1234);
    Image depth = image;
    depth.values()[77].depth = std::nextafter(depth.values()[77].depth, 0.0);
    EXPECT_EQ(compare(image, depth).differing_depths, 1);
    Image sign = image;
    sign.values()[5].depth = -sign.values()[5].depth;
    EXPECT_FALSE(compare(image, sign).same());
}

INSTANTIATE_TEST_SUITE_P(Precisions, SameBits, testing::Values(Precision::f64, Precision::f32),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace mandelmarch
