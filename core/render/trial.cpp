// SPDX-License-Identifier: Apache-2.0
#include "core/render/trial.h"

#include <algorithm>
#include <cmath>

#include "core/image/compare.h"
#include "core/render/stepping.h"

namespace mandelmarch {
namespace {

// docs/notes/experiments.md, "Trials", explains these constants.
constexpr double trial_pixels = 1024;
constexpr double most_off = 0.015;   // max fraction of the trial's pixels that may differ visibly
constexpr double converging = 0.75;  // max ratio of the fraction that differs to that of the comparison before

double share_off(const Image& a, const Image& b)
{
    const Comparison c = compare(a, b);
    return static_cast<double>(c.visibly_differing) / static_cast<double>(c.pixels);
}

class TrialRenderer : public Renderer {
public:
    explicit TrialRenderer(std::unique_ptr<Renderer> renderer) : renderer_(std::move(renderer)) {}

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        if (scene.limits.tried) return renderer_->render(scene, image, progress);
        // A small picture is a sign of life and can be cancelled, but is no fraction of the picture.
        const Progress of_trial = progress ? Progress([&](double) { progress(0); }) : Progress();
        Timings spent;
        const Trial trial = try_steps(scene, [&](const Scene& small, Image& picture) {
            spent += renderer_->render(small, picture, of_trial).timings;
        });
        Scene tried = scene;
        tried.limits.step_factor = trial.step_factor;
        RenderStats report = renderer_->render(tried, image, progress);
        report.timings += spent;
        report.step_factor = trial.step_factor;
        report.unsettled = trial.settled() ? 0 : trial.off;
        return report;
    }

private:
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace

bool Trial::settled() const { return off <= most_off; }

Scene trial_scene(const Scene& scene)
{
    Scene small = scene;
    const double pixels = static_cast<double>(scene.width) * scene.height;
    const double scale = std::min(1.0, std::sqrt(trial_pixels / pixels));
    small.width = std::max(1, static_cast<int>(std::lround(scale * scene.width)));
    small.height = std::max(1, static_cast<int>(std::lround(scale * scene.height)));
    const auto scaled = [&](int pixels_of_part) { return static_cast<int>(std::lround(scale * pixels_of_part)); };
    if (scene.crop_window.whole_width > 0) {
        small.crop_window = {scaled(scene.crop_window.left), scaled(scene.crop_window.bottom),
                             std::max(1, scaled(scene.crop_window.whole_width)),
                             std::max(1, scaled(scene.crop_window.whole_height))};
    }
    return small;
}

Trial try_steps(const Scene& scene, const std::function<void(const Scene&, Image&)>& draw)
{
    Scene small = trial_scene(scene);
    const auto drawn = [&](double step_factor) {
        small.limits.step_factor = step_factor;
        Image image(small.width, small.height, Image::Layers::bytes);
        draw(small, image);
        return image;
    };
    const double usual = stepping_of(scene, Mode::fast).step_factor;
    Trial trial{usual};
    double last_off = 1;
    Image picture = drawn(usual);
    for (const double next : shorter_step_factors) {
        if (next >= usual) continue;
        Image again = drawn(next);
        trial.off = share_off(picture, again);
        if (trial.settled()) return trial;
        if (trial.off > converging * last_off) return {usual, trial.off};
        trial.step_factor = next;
        last_off = trial.off;
        picture = std::move(again);
    }
    return trial;
}

bool is_tried(const RendererOptions& options)
{
    // Without refinement every step factor gives another picture, so a trial is useless.
    return options.mode == Mode::fast && options.techniques.refinement && options.techniques.trial;
}

Trial try_steps(const Scene& scene, const Backend& backend, RendererOptions options)
{
    options.techniques.trial = false;
    const auto renderer = backend.create(options);
    return try_steps(scene, [&](const Scene& small, Image& picture) { renderer->render(small, picture); });
}

std::unique_ptr<Renderer> Backend::create(const RendererOptions& options) const
{
    const BackendInfo properties = info();
    if (!is_tried(options) || properties.role == Role::reference || properties.replays) return do_create(options);
    RendererOptions untried = options;
    untried.techniques.trial = false;
    return std::make_unique<TrialRenderer>(do_create(untried));
}

}  // namespace mandelmarch
