// SPDX-License-Identifier: Apache-2.0
// Backends with a defect must fail the check of equivalence. The same backends pass if they have no defect.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "backends/all.h"
#include "bench/fidelity/equivalence.h"
#include "core/models/model.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace skeleton {
job::DrawKernel* drawing(std::string_view variant);
job::DrawKernel* wrong_fold(std::string_view variant);
job::DrawKernel* contracted(std::string_view variant);
}  // namespace skeleton

namespace {

// last_picture: returns the previous picture if it has the right size. other_work: does not report any work.
enum class Defect { none, wrong_fold, contraction, not_a_number, last_picture, upside_down, other_work, error };

// Returns a variant of the Mandelbox as a variant of the mutant.
std::string named(const char* mutant, std::string_view variant)
{
    return mutant + std::string(variant.substr(std::string_view("mandelbox").size()));
}

// The skeleton with the Mandelbox's kernels of a mutant.
class Mutant : public job::Model {
public:
    explicit Mutant(Defect defect) : defect_(defect) {}
    std::string_view name() const override { return "broken"; }
    BackendInfo info() const override { return {.replays = true}; }  // without a trial, whose pictures are others
    job::Kernels kernels() const override
    {
        if (defect_ == Defect::wrong_fold) {
            return {[](std::string_view variant) { return skeleton::wrong_fold(named("wrong_fold", variant)); },
                    nullptr};
        }
        if (defect_ == Defect::contraction) {
            return {[](std::string_view variant) { return skeleton::contracted(named("contracted", variant)); },
                    nullptr};
        }
        return {skeleton::drawing, nullptr};
    }
    job::OpenedDevice open(int) const override { return {.in_cells = true}; }

private:
    Defect defect_;
};

class BrokenRenderer : public Renderer {
public:
    BrokenRenderer(Defect defect, const RendererOptions& options)
        : defect_(defect), renderer_(job::backend_of(std::make_unique<Mutant>(defect))->create(options))
    {
    }

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        if (defect_ == Defect::error) throw Error("the device is broken");
        if (defect_ == Defect::last_picture && last_.width() == image.width() && last_.height() == image.height()) {
            image = last_;
            return last_report_;
        }
        RenderStats report = renderer_->render(scene, image, progress);
        if (defect_ == Defect::other_work) report.work = {};
        if (defect_ == Defect::not_a_number) {
            image.values().at(image.pixels() / 2).green = std::numeric_limits<double>::quiet_NaN();
        }
        if (defect_ == Defect::upside_down) {
            std::ranges::reverse(image.values());  // also swaps left and right
            std::ranges::reverse(image.bytes());
        }
        last_ = image;
        last_report_ = report;
        return report;
    }

private:
    Defect defect_;
    std::unique_ptr<Renderer> renderer_;
    Image last_;
    RenderStats last_report_;
};

class BrokenBackend : public Backend {
public:
    BrokenBackend(Defect defect, std::string_view name) : defect_(defect), name_(name) {}
    std::string_view name() const override { return name_; }
    BackendInfo info() const override { return {.replays = true}; }
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
