// SPDX-License-Identifier: Apache-2.0
// Backends with a defect must fail the check of equivalence. The same backends pass if they have no defect.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "backends/openmp/openmp.h"
#include "backends/reference/reference.h"
#include "bench/fidelity/equivalence.h"
#include "core/text/error.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "tests/equivalence/broken_kernels.h"
#include "tests/scenes.h"

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
    BrokenBackend(Defect defect, std::string_view name) : defect_(defect), name_(name) {}
    std::string_view name() const override { return name_; }
    BackendInfo info() const override { return {.replays = true}; }  // without a trial, whose pictures are others
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

// Returns what is found when a backend with each defect, "first", "second", is compared with openmp or the reference.
bench::EquivalenceResult found_in(const std::vector<Defect>& defects, Mode mode, const std::vector<NamedScene>& scenes)
{
    static constexpr std::string_view names[] = {"first", "second"};
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_reference_backend());
    backends.push_back(make_openmp_backend());
    bench::EquivalenceOptions options{
        .fractals = {&fractal_named("box")}, .scenes = 10, .seed = 20, .mode = mode, .others = scenes};
    for (std::size_t i = 0; i < defects.size(); ++i) {
        backends.push_back(std::make_unique<BrokenBackend>(defects[i], names[i]));
        options.backends.emplace_back(names[i]);
    }
    return bench::compare_backends(Registry(std::move(backends)), options);
}

// Returns true if a backend with this defect passes in both precisions, and false if it fails in both.
bool passes(Defect defect, Mode mode, const std::vector<NamedScene>& scenes = {})
{
    const bench::EquivalenceResult result = found_in({defect}, mode, scenes);
    EXPECT_EQ(result.subjects.size(), 2U);
    for (const bench::Tested& subject : result.subjects) {
        EXPECT_EQ(subject.pictures, defect == Defect::error ? 0 : scenes.empty() ? 10 : std::ssize(scenes));
        EXPECT_EQ(subject.wrong > 0, !result.discrepancies.empty()) << subject.name();
    }
    return result.discrepancies.empty();
}

TEST(RandomScenes, FindEveryDefect)
{
    EXPECT_TRUE(passes(Defect::none, Mode::exact));
    for (const Defect defect : {Defect::wrong_fold, Defect::not_a_number, Defect::last_picture, Defect::upside_down,
                                Defect::other_work, Defect::error}) {
        EXPECT_FALSE(passes(defect, Mode::exact)) << static_cast<int>(defect);
    }
    if (__builtin_cpu_supports("fma")) {
        EXPECT_FALSE(passes(Defect::contraction, Mode::exact));
    }
}

TEST(Broken, FastPicturesAreFound)
{
    std::vector<NamedScene> scenes(2, {"near", official_scene("box", 90, 60)});
    scenes.back().scene.eye = {9, 8, 11};
    EXPECT_TRUE(passes(Defect::none, Mode::fast, scenes));
    for (const Defect defect : {Defect::wrong_fold, Defect::not_a_number, Defect::last_picture, Defect::upside_down}) {
        EXPECT_FALSE(passes(defect, Mode::fast, scenes)) << static_cast<int>(defect);
    }
}

// Negative control: two backends with different defects do not agree.
TEST(Broken, ThatAgreeMakeTheExpectedPictureSuspect)
{
    const auto suspected = [](Defect a, Defect b) {
        const auto all = found_in({a, b}, Mode::exact, {{"near", official_scene("box", 90, 60)}}).discrepancies;
        EXPECT_EQ(all.size(), 4U);
        return std::ranges::count_if(all, [](const bench::Discrepancy& one) {
            return one.what.ends_with("; first has the same picture: suspect the expected one");
        });
    };
    EXPECT_EQ(suspected(Defect::wrong_fold, Defect::wrong_fold), 2);  // in both precisions
    EXPECT_EQ(suspected(Defect::wrong_fold, Defect::upside_down), 0);
}

}  // namespace
}  // namespace mandelmarch
