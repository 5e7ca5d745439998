// SPDX-License-Identifier: Apache-2.0
// Tests trials. If fast mode's usual steps miss parts of a scene's surface, a trial shows this, and the scene is
// rendered with shorter steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/render/region.h"
#include "core/render/trial.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

// Synthetic pictures for a trial. In the picture of call i, off[i] thousandths of the pixels have a colour that no
// other picture has; the other pixels are black. The number of pixels in which two pictures differ is therefore the
// larger of their two values of `off`, in thousandths.
struct Pictures {
    std::vector<int> off;
    std::vector<double> strides{};  // step factors of the calls

    Trial tried(const Scene& scene)
    {
        return try_steps(scene, [&](Renderer::SmallPicture& small) {
            EXPECT_LE(small.scene.width * small.scene.height, 1100);
            auto& bytes = small.image.bytes();
            std::ranges::fill(bytes, static_cast<unsigned char>(0));
            const auto share = static_cast<std::size_t>(off.at(strides.size()));
            strides.push_back(small.scene.limits.step_factor);
            std::fill_n(bytes.begin(), bytes.size() * share / 1000, static_cast<unsigned char>(10 * strides.size()));
        });
    }
};

TEST(Trial, ShortensStepsUntilPicturesAgree)
{
    const Scene bulb = official_scene("bulb", 1080, 1080);
    Pictures agree{{0, 14}};
    EXPECT_EQ(agree.tried(bulb).step_factor, plain_step_factor);
    EXPECT_EQ(agree.strides, (std::vector{plain_step_factor, 0.4}));
    Pictures settle{{60, 0, 14}};
    const Trial settled = settle.tried(bulb);
    EXPECT_EQ(settled.step_factor, 0.4);
    EXPECT_TRUE(settled.settled());
    EXPECT_EQ(settle.strides, (std::vector{plain_step_factor, 0.4, 0.2}));
    Pictures come_nearer{{90, 40, 0, 20}};
    EXPECT_EQ(come_nearer.tried(bulb).step_factor, 0.1);
    Pictures stay_apart{{0, 60, 60, 60}};
    const Trial apart = stay_apart.tried(bulb);
    EXPECT_EQ(apart.step_factor, plain_step_factor);
    EXPECT_FALSE(apart.settled());
    EXPECT_NEAR(apart.off, 0.06, 0.001);
    EXPECT_EQ(stay_apart.strides, (std::vector{plain_step_factor, 0.4, 0.2}));
    Scene low = bulb;
    low.shape[2] = 3;  // power 3, for which the usual step factor is 0.4
    Pictures low_agree{{0, 0}};
    EXPECT_EQ(low_agree.tried(low).step_factor, 0.4);
    EXPECT_EQ(low_agree.strides, (std::vector{0.4, 0.2}));
    Scene shortest = bulb;
    shortest.limits.step_factor = 0.1;  // no shorter steps are tried; therefore no difference is found
    Pictures once{{60}};
    const Trial untried = once.tried(shortest);
    EXPECT_EQ(untried.step_factor, 0.1);
    EXPECT_TRUE(untried.settled());
}

Scene random_bulb(unsigned seed, int number)
{
    return random_scenes(60, seed).at(static_cast<std::size_t>(number)).scene;
}

// In the scenes of this test, more than 2 % of the pixels are off with fast mode's usual steps.
TEST(Trial, BringsPicturesNearTheCanonicalOnes)
{
    const Registry registry = all_backends();
    const std::vector<Scene> scenes{random_bulb(1001, 12), random_bulb(3003, 20), random_bulb(6006, 14)};
    for (const Scene& scene : scenes) {
        const Image canonical = render(*registry.find("reference"), scene, {.mode = Mode::fast});
        for (const Precision precision : {Precision::f64, Precision::f32}) {
            const auto off = [&](bool trial) {
                const RendererOptions options{
                    .precision = precision, .mode = Mode::fast, .techniques = {.trial = trial}};
                return compare(canonical, render(*registry.find("openmp"), scene, options)).visibly_differing;
            };
            EXPECT_LE(50 * off(true), canonical.pixels()) << scene.shape[2];
            EXPECT_GT(50 * off(false), canonical.pixels()) << scene.shape[2];  // negative control
        }
    }
}

TEST(Trial, ChangesNothingWhereStepsWereFine)
{
    const auto openmp = make_openmp_backend();
    const auto same_untried = [&](const Scene& scene, RendererOptions options) {
        const Image tried = render(*openmp, scene, options);
        options.techniques.trial = false;
        return compare(tried, render(*openmp, scene, options)).same();
    };
    for (const char* name : {"bulb", "box"}) {
        for (const auto& [width, height] : {std::pair(270, 270), {1, 1}, {300, 2}}) {
            const Scene scene = official_scene(name, width, height);
            for (const Precision precision : {Precision::f64, Precision::f32}) {
                EXPECT_TRUE(same_untried(scene, {.precision = precision, .mode = Mode::fast})) << name;
            }
        }
    }
    // Exact pictures and pictures whose hits are not refined have no trial.
    const Scene scene = random_bulb(1001, 12);
    EXPECT_TRUE(same_untried(scene, {}));
    EXPECT_TRUE(same_untried(scene, {.mode = Mode::fast, .techniques = {.refinement = false}}));
}

// The width of each picture, and whether a trial has chosen its steps.
using Recorded = std::vector<std::pair<int, bool>>;

// A backend that draws nothing, but records its pictures.
class Recorder : public Backend, public Renderer {
public:
    explicit Recorder(Recorded& pictures) : pictures_(pictures) {}
    std::string_view name() const override { return "recording"; }
    std::optional<std::string> unavailable() const override { return std::nullopt; }
    std::vector<Device> devices() const override { return {Device{}}; }
    std::unique_ptr<Renderer> do_create(const RendererOptions&) const override
    {
        return std::make_unique<Recorder>(pictures_);
    }
    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        pictures_.emplace_back(image.width(), scene.limits.tried);
        std::ranges::fill(image.bytes(), std::uint8_t{0});
        if (progress) progress(1);
        return {};
    }

private:
    Recorded& pictures_;
};

TEST(Trial, EndsAfterThePictureInWhichItIsCancelled)
{
    Recorded pictures;
    const auto renderer = Recorder(pictures).create({.mode = Mode::fast});
    Image image(320, 320, Image::Layers::bytes);
    const Scene scene = official_scene("bulb", 320, 320);
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(renderer->render(scene, image, Progress(source.get_token())), Cancelled);
    EXPECT_EQ(pictures, (Recorded{{32, false}}));
    std::vector<double> shares;
    renderer->render(scene, image, [&](double share) { shares.push_back(share); });
    EXPECT_EQ(shares, (std::vector<double>{0, 0, 1}));
}

TEST(Trial, OfTheFirstStripServesTheWholeRegion)
{
    Recorded pictures;
    const auto renderer = Recorder(pictures).create({.mode = Mode::fast});
    const RenderStats report =
        render_region(*renderer, official_scene("bulb", 4096, 4096), {7, 0, 40, 2048}, Image::Layers::bytes).second;
    EXPECT_EQ(pictures, (Recorded{{32, false}, {32, false}, {4096, false}, {4096, true}}));
    EXPECT_EQ(report.step_factor, plain_step_factor);
}

}  // namespace
}  // namespace mandelmarch
