// SPDX-License-Identifier: Apache-2.0
// Real backends pass the equivalence checks. Backends with a defect must fail them, on the tests' scenes and on random
// scenes. The same backends pass if they have no defect.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "backends/all.h"
#include "backends/openmp/openmp.h"
#include "bench/scenes/equivalence.h"
#include "core/base/error.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "tests/equivalence/broken_kernels.h"
#include "tests/equivalence/equivalence.h"

namespace mandelmarch {
namespace {

// last_picture: returns the previous picture if it has the right size. other_work: does not report any work.
enum class Defect { none, wrong_fold, contraction, not_a_number, last_picture, upside_down, other_work, error };

class BrokenRenderer : public Renderer {
public:
    BrokenRenderer(Defect defect, const RendererOptions& options) : defect_(defect), options_(options) {}

    RenderStats render(const Scene& scene, Image& image, const Progress&) override
    {
        if (defect_ == Defect::error) throw Error("the device is broken");
        RenderStats report = last_report_;
        if (defect_ == Defect::last_picture && last_.width() == image.width() && last_.height() == image.height()) {
            image = last_;
        } else {
            report = {.backend = "broken", .device = {}, .instruction_set = {}, .timings = {}, .work = {}};
            options_.precision == Precision::f32 ? draw<float>(scene, image, report.work)
                                                 : draw<double>(scene, image, report.work);
        }
        last_ = image;
        last_report_ = report;
        return report;
    }

private:
    template <class Real>
    void draw(const Scene& scene, Image& image, Work& work) const
    {
        const auto variant = [&](const char* kernel) {
            return fmt::format("{}_{}", kernel, name_of(options_.precision));
        };
        skeleton::DrawBand<Real>* const kernel =
            defect_ == Defect::wrong_fold    ? skeleton::wrong_fold<Real>(variant("wrong_fold"))
            : defect_ == Defect::contraction ? skeleton::contracted<Real>(variant("contracted"))
                                             : skeleton::kernel_of<Real>(variant("mandelbox"));
        const std::size_t pixels = image.pixels();
        std::vector<Real> reals(real_planes * pixels);
        std::vector<int> wholes(whole_planes * pixels);
        kernel(kernel_scene<KernelScene<Real>>(scene, options_.mode), 0, image.height(), pixels, reals.data(),
               wholes.data());
        if (defect_ == Defect::not_a_number) reals[pixels + pixels / 2] = std::numeric_limits<Real>::quiet_NaN();
        const auto width = static_cast<std::size_t>(image.width());
        if (defect_ != Defect::other_work) {
            add_work(work, planes_of(reals.data(), wholes.data(), pixels, width), image.width(), image.height());
        }
        for (int j = 0; j < image.height(); ++j) {
            const int from = defect_ == Defect::upside_down ? image.height() - 1 - j : j;
            const std::size_t at = static_cast<std::size_t>(from) * width;
            image.store(planes_of(reals.data() + at, wholes.data() + at, pixels, width), 0, j, image.width(), 1);
        }
    }

    Defect defect_;
    RendererOptions options_;
    Image last_;
    RenderStats last_report_;
};

class BrokenBackend : public Backend {
public:
    explicit BrokenBackend(Defect defect, std::string_view name = "broken") : defect_(defect), name_(name) {}
    std::string_view name() const override { return name_; }
    std::optional<std::string> unavailable() const override { return std::nullopt; }
    std::vector<Device> devices() const override { return {Device{}}; }
    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        return std::make_unique<BrokenRenderer>(defect_, options);
    }

private:
    Defect defect_;
    std::string_view name_;
};

class Broken : public testing::TestWithParam<Precision> {
protected:
    const Registry registry = all_backends();

    bool passes(Defect defect, Mode mode)
    {
        Expected expected(registry);
        std::vector<NamedScene> scenes;
        scenes.push_back({"near", official_scene("box", 90, 60)});
        scenes.push_back({"far", official_scene("box", 90, 60)});
        scenes.back().scene.eye = {9, 8, 11};
        // The pictures of a trial would be the last ones.
        const RendererOptions options{.precision = GetParam(), .mode = mode, .techniques = techniques_without("trial")};
        return check(BrokenBackend(defect), options, "box", scenes, expected).passed();
    }
};

TEST_P(Broken, WithoutADefectItPasses)
{
    EXPECT_TRUE(passes(Defect::none, Mode::exact));
    EXPECT_TRUE(passes(Defect::none, Mode::fast));
}

TEST_P(Broken, WithADefectItFails)
{
    for (const Defect defect : {Defect::wrong_fold, Defect::not_a_number, Defect::last_picture, Defect::upside_down}) {
        EXPECT_FALSE(passes(defect, Mode::exact)) << static_cast<int>(defect);
        EXPECT_FALSE(passes(defect, Mode::fast)) << static_cast<int>(defect);
    }
    if (__builtin_cpu_supports("fma")) {
        EXPECT_FALSE(passes(Defect::contraction, Mode::exact));
    }
}

// If two backends have the same picture, the expected one, which openmp renders, is suspect. Negative control: with two
// different defects it is not.
TEST_P(Broken, ThatAgreeMakeTheExpectedPictureSuspect)
{
    const std::vector<NamedScene> scenes{{"near", official_scene("box", 90, 60)}};
    const auto second = [&](Defect a, Defect b) {
        Expected expected(registry);
        const RendererOptions options{.precision = GetParam()};
        check(BrokenBackend(a, "first"), options, "box", scenes, expected);
        return check(BrokenBackend(b, "second"), options, "box", scenes, expected).first;
    };
    EXPECT_TRUE(second(Defect::wrong_fold, Defect::wrong_fold).ends_with("suspect openmp's scalar kernel"));
    const std::string different = second(Defect::wrong_fold, Defect::upside_down);
    EXPECT_EQ(different.find("suspect"), std::string::npos);
    EXPECT_NE(different.find("bin/render --fractal box"), std::string::npos);
    EXPECT_TRUE(different.ends_with("--trace")) << different;
}

// Returns true if a backend with this defect passes the random scenes of `bench equivalence`.
bool passes_random_scenes(Defect defect)
{
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_openmp_backend());
    backends.push_back(std::make_unique<BrokenBackend>(defect));
    const bench::EquivalenceOptions options{
        .backends = {"broken"}, .fractals = {&fractal_named("box")}, .scenes = 10, .seed = 20};
    const auto result = bench::compare_backends(
        Registry(std::move(backends)), options, [](const bench::Discrepancy&) {}, [](double) {});
    EXPECT_EQ(result.subjects.size(), 2U);
    for (const bench::Tested& subject : result.subjects) {
        EXPECT_EQ(subject.pictures, defect == Defect::error ? 0 : 10);
        EXPECT_EQ(subject.wrong > 0, !result.discrepancies.empty()) << subject.name();
    }
    return result.discrepancies.empty();
}

TEST(RandomScenes, FindEveryDefect)
{
    EXPECT_TRUE(passes_random_scenes(Defect::none));
    for (const Defect defect : {Defect::wrong_fold, Defect::not_a_number, Defect::last_picture, Defect::upside_down,
                                Defect::other_work, Defect::error}) {
        EXPECT_FALSE(passes_random_scenes(defect)) << static_cast<int>(defect);
    }
    if (__builtin_cpu_supports("fma")) {
        EXPECT_FALSE(passes_random_scenes(Defect::contraction));
    }
}

INSTANTIATE_TEST_SUITE_P(Precisions, Broken, testing::Values(Precision::f64, Precision::f32),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace mandelmarch
