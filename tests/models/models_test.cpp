// SPDX-License-Identifier: Apache-2.0
// Every backend reports its device, threads and times, and has a peak. tests/equivalence tests the pictures.
#include <gtest/gtest.h>

#include <ctime>

#include "backends/all.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

class Models : public testing::TestWithParam<std::string> {
protected:
    const Registry registry = all_backends();
    const Backend& model = *registry.find(GetParam());

    void SetUp() override
    {
        if (const auto why = model.unavailable()) GTEST_SKIP() << *why;
    }

    static RenderStats drawn(Renderer& renderer, int side)
    {
        Image image(side, side, Image::Layers::bytes);
        return renderer.render(official_scene("bulb", side, side), image);
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

// A model that reports several threads must use them. The picture does not show this: a loop on one thread gives the
// same picture.
TEST_P(Models, ThreadsThatAreReportedWork)
{
    const auto renderer = model.create({});
    drawn(*renderer, 32);  // starts the threads
    const double before = seconds_of_others();
    const RenderStats report = drawn(*renderer, 540);
    if (report.threads > 1 && !report.device.is_gpu) {
        EXPECT_GT(seconds_of_others() - before, 0.005);
    }
}

TEST_P(Models, TimesArePartsOfTheWallTime)
{
    const bool compiles = GetParam() == "opencl" || GetParam() == "vulkan";  // its kernels, at run time
    const auto renderer = model.create({.precision = Precision::f32});
    const RenderStats report = drawn(*renderer, 150);
    EXPECT_EQ(report.backend, model.name());
    EXPECT_EQ(report.device.name, model.devices().front().name);
    EXPECT_EQ(report.precision, Precision::f32);
    const Timings& first = report.timings;
    EXPECT_GT(first.kernel, 0);
    EXPECT_GE(first.wall, first.build + first.upload + first.host + first.readback);
    EXPECT_TRUE(!compiles || (first.context > 0 && first.build > 0 && first.upload > 0 && first.readback > 0));
    EXPECT_EQ(drawn(*renderer, 150).timings.build, 0);
}

// Models that do not support the option `threads`, and GPUs, ignore it.
TEST_P(Models, ThreadsOfTheOptionAreUsedIfSupported)
{
    const RenderStats one = drawn(*model.create({.threads = 1}), 70);
    const RenderStats three = drawn(*model.create({.threads = 3}), 70);
    const bool supported = model.info().threads && !one.device.is_gpu;
    EXPECT_EQ(one.threads, supported ? 1 : three.threads);
    EXPECT_EQ(three.threads, supported ? 3 : one.threads);
}

TEST_P(Models, PeakIsInOperationsPerSecond)
{
    for (const Precision precision : {Precision::f64, Precision::f32}) {
        const auto peak = model.multiply_add_peak({.precision = precision});
        ASSERT_TRUE(peak.has_value());
        EXPECT_GT(*peak, 1e8);  // a smaller value must be in a wrong unit
    }
}

// Returns the names of the backends of this build that compile the kernel.
std::vector<std::string> names()
{
    const Registry registry = all_backends();
    std::vector<std::string> all;
    for (const auto& backend : registry.backends()) {
        const BackendInfo info = backend->info();
        if (info.role == Role::reference || info.build.compiler.empty()) continue;
        all.emplace_back(backend->name());
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(All, Models, testing::ValuesIn(names()), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace mandelmarch
