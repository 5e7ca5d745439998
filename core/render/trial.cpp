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

Scene with(Scene scene, double step_factor)
{
    scene.limits.step_factor = step_factor;
    return scene;
}

Renderer::SmallPicture small_picture(const Scene& scene, double step_factor)
{
    const Scene small = with(trial_scene(scene), step_factor);
    return {small, Image(small.width, small.height, Image::Layers::bytes)};
}

// Returns the first of the shorter step factors that is shorter than this one; this one if there is none.
double next_shorter(double step_factor)
{
    const auto* next = std::ranges::find_if(shorter_step_factors, [&](double f) { return f < step_factor; });
    return next == shorter_step_factors.end() ? step_factor : *next;
}

class TrialRenderer : public Renderer {
public:
    explicit TrialRenderer(std::unique_ptr<Renderer> renderer) : renderer_(std::move(renderer)) {}

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        if (scene.limits.tried) return renderer_->render(scene, image, progress);
        const double usual = stepping_of(scene, Mode::fast).step_factor;
        // The pictures that a trial compares first.
        std::vector<SmallPicture> first;
        for (const double step_factor : {usual, next_shorter(usual)})
            first.push_back(small_picture(scene, step_factor));
        std::optional<RenderStats> report = renderer_->render_beside(first, with(scene, usual), image, progress);
        // A small picture is a sign of life and can be cancelled, but is no fraction of the picture.
        const Progress of_trial = progress ? Progress([&](double) { progress(0); }) : Progress();
        Timings spent;
        const Trial trial = try_steps(scene, [&](SmallPicture& wanted) {
            for (SmallPicture& known : first) {
                if (!report || known.scene.limits.step_factor != wanted.scene.limits.step_factor) continue;
                wanted.image = std::move(known.image);
                return;
            }
            spent += renderer_->render(wanted.scene, wanted.image, of_trial).timings;
        });
        if (report && trial.step_factor != usual) {
            spent += report->timings;
            report.reset();
        }
        if (!report) report = renderer_->render(with(scene, trial.step_factor), image, progress);
        spent.trial = spent.kernel;
        report->timings += spent;
        report->step_factor = trial.step_factor;
        report->unsettled = trial.settled() ? 0 : trial.off;
        return *report;
    }

    std::shared_ptr<void> lock_memory(std::span<std::uint8_t> memory) override
    {
        return renderer_->lock_memory(memory);
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

Trial try_steps(const Scene& scene, const std::function<void(Renderer::SmallPicture&)>& draw)
{
    const auto drawn = [&](double step_factor) {
        Renderer::SmallPicture small = small_picture(scene, step_factor);
        draw(small);
        return std::move(small.image);
    };
    const double usual = stepping_of(scene, Mode::fast).step_factor;
    Trial trial{usual};
    double last_off = 1;
    Image picture = drawn(usual);
    while (next_shorter(trial.step_factor) < trial.step_factor) {
        const double next = next_shorter(trial.step_factor);
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
    return try_steps(scene, [&](Renderer::SmallPicture& small) { renderer->render(small.scene, small.image); });
}

std::unique_ptr<Renderer> Backend::create(const RendererOptions& options) const
{
    const BackendInfo properties = info();
    if (!is_tried(options) || properties.role == Role::reference || properties.replays || runs_trials()) {
        return do_create(options);
    }
    RendererOptions untried = options;
    untried.techniques.trial = false;
    return std::make_unique<TrialRenderer>(do_create(untried));
}

}  // namespace mandelmarch
