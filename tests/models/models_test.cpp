// SPDX-License-Identifier: Apache-2.0
// Every programming model gives the bits of the scalar kernel in pictures of every shape, and reports its device and
// times. Negative controls are in mutants_test.cpp; tests/equivalence tests odd scenes, fast mode and work counts.
#include <gtest/gtest.h>

#include <ctime>
#include <sstream>

#include "backends/all.h"
#include "core/text/error.h"
#include "core/image/compare.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

class Models : public testing::TestWithParam<std::tuple<std::string, Precision>> {
protected:
    const Registry registry = all_backends();
    const Backend& model = *registry.find(std::get<0>(GetParam()));
    const Backend& openmp = *registry.find("openmp");
    const Precision precision = std::get<1>(GetParam());

    void SetUp() override
    {
        if (const auto why = model.unavailable()) GTEST_SKIP() << *why;
    }

    static std::vector<NamedScene> scenes()
    {
        std::vector<NamedScene> all;
        for (const char* fractal : {"bulb", "box"}) {
            all.push_back({fractal, official_scene(fractal, 270, 270)});
            all.push_back({"one pixel", official_scene(fractal, 1, 1)});
            all.push_back({"six pixels", official_scene(fractal, 3, 2)});
            all.push_back({"one column", official_scene(fractal, 1, 201)});
            all.push_back({"one row", official_scene(fractal, 20000, 1)});  // has more pixels than a small band
        }
        return all;
    }
};

double seconds_of(clockid_t clock)
{
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Returns the processor seconds of all threads except this one, including threads that have ended.
double seconds_of_others() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID) - seconds_of(CLOCK_THREAD_CPUTIME_ID); }

TEST_P(Models, ExactHasTheBitsOfTheScalarText)
{
    for (const auto& [name, scene] : scenes()) {
        const Image expected = render(openmp, scene, {.precision = precision, .simd_width = 1});
        const Image image = render(model, scene, {.precision = precision});
        const Comparison difference = compare(expected, image);
        EXPECT_TRUE(difference.same()) << name << ": "
                                       << describe_pixel(expected, image, std::max<std::int64_t>(0, difference.first));
    }
}

// A model that reports several threads must use them. The picture does not show this: a loop on one thread gives the
// same picture.
TEST_P(Models, MoreThanOneThreadDrawsWhereItSaysSo)
{
    const auto renderer = model.create({.precision = precision});
    const auto drawn = [&](int side) {
        Image image(side, side, Image::Layers::bytes);
        return renderer->render(official_scene("bulb", side, side), image);
    };
    drawn(32);  // starts the threads
    const double before = seconds_of_others();
    const RenderStats report = drawn(540);
    if (report.threads > 1 && !report.device.is_gpu) {
        EXPECT_GT(seconds_of_others() - before, 0.005);
    }
}

TEST_P(Models, ReportsItsDeviceAndTimes)
{
    const Scene scene = official_scene("box", 200, 150);
    Image image(scene.width, scene.height, Image::Layers::bytes);
    const RenderStats report = model.create({.precision = precision})->render(scene, image);
    EXPECT_EQ(report.backend, model.name());
    EXPECT_EQ(report.device.name, model.devices().front().name);
    EXPECT_EQ(report.precision, precision);
    const Timings& t = report.timings;
    EXPECT_GT(t.kernel, 0);
    EXPECT_LE(t.upload + t.host + t.readback, t.wall);
}

// Models that do not support the option `threads`, and GPUs, ignore it.
TEST_P(Models, HeedThreadsWhereTheySaySo)
{
    const Scene scene = official_scene("box", 90, 70);
    Image image(scene.width, scene.height, Image::Layers::bytes);
    const RenderStats report = model.create({.precision = precision, .threads = 1})->render(scene, image);
    const RenderStats three = model.create({.precision = precision, .threads = 3})->render(scene, image);
    const bool heeds = model.info().threads && !report.device.is_gpu;
    EXPECT_EQ(report.threads, heeds ? 1 : three.threads);
    EXPECT_EQ(three.threads, heeds ? 3 : report.threads);
}

TEST_P(Models, RefuseADeviceThatIsNotThere)
{
    EXPECT_THROW(model.create({.device = static_cast<int>(model.devices().size())}), Unavailable);
}

TEST_P(Models, HaveAPeak)
{
    const auto peak = model.multiply_add_peak({.precision = precision});
    ASSERT_TRUE(peak.has_value());
    EXPECT_GT(*peak, 1e8);  // operations per second; a smaller value must be in a wrong unit
}

std::vector<std::string> names()
{
    std::istringstream list(MANDELMARCH_TESTED_MODELS);
    return {std::istream_iterator<std::string>(list), {}};
}

INSTANTIATE_TEST_SUITE_P(All, Models,
                         testing::Combine(testing::ValuesIn(names()), testing::Values(Precision::f64, Precision::f32)),
                         [](const auto& test) {
                             return std::get<0>(test.param) + "_" + std::string(name_of(std::get<1>(test.param)));
                         });

}  // namespace
}  // namespace mandelmarch
