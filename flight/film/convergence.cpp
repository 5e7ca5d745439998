// SPDX-License-Identifier: Apache-2.0
#include "flight/film/convergence.h"

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>

#include "core/image/compare.h"
#include "core/text/quantile.h"
#include "flight/audit/views.h"
#include "flight/field/threads.h"
#include "flight/route/random.h"

namespace mandelmarch {
namespace {

constexpr std::size_t every = 100;  // frames from one compared frame to the next
constexpr int strata = 4;           // a frame is divided into strata x strata cells; each has one patch at random
constexpr int place_width = 48;     // pixels; width of a patch
constexpr int place_height = 27;    // pixels; height of a patch
constexpr double converged = 0.06;  // step factor; with a smaller one, far rays reach the limit on the number of steps
// Thresholds, in percent of a frame's pixels.
constexpr double median_bar = 2;
constexpr double most_frames_bar = 4;
constexpr double worst_bar = 6;

// Returns the options of a film, except that each pixel computes its own occlusion. The comparison leaves out shared
// occlusion, because it changes the lighting but not the steps.
RendererOptions by_film_steps(const RendererOptions& options)
{
    RendererOptions alone = without_trial(options);
    alone.techniques.shared_occlusion = false;
    return alone;
}

// Returns options with which every ray marches its whole length. With the film's options, rays may begin close to the
// hits of neighbouring rays or where a cone has ended.
RendererOptions by_short_steps(const RendererOptions& options)
{
    RendererOptions alone = by_film_steps(options);
    alone.techniques.neighbours = false;
    alone.techniques.cones = false;
    return alone;
}

Scene by_short_steps(Scene scene)
{
    scene.limits = {.step_factor = converged, .root_share = 0};
    return scene;
}

class Comparer {
public:
    Comparer(const Path& path, const Backend& backend, const RendererOptions& options, const Picture& picture)
        : scenes_(path, picture),
          film_(backend.create(by_film_steps(options))),
          truth_(backend.create(by_short_steps(options)))
    {
    }

    // Estimates, from random patches, the percentage of a frame's pixels that differ visibly from the converged
    // picture.
    double off(std::size_t frame) const
    {
        Scene scene = scenes_.scene(frame);
        scene.crop_window = {.whole_width = scene.width, .whole_height = scene.height};
        FlightRandom random(frame);
        double differing = 0;
        double pixels = 0;
        for (int stratum = 0; stratum < strata * strata; ++stratum) {
            std::tie(scene.crop_window.left, scene.width) =
                place(scene.crop_window.whole_width, stratum % strata, place_width, random);
            std::tie(scene.crop_window.bottom, scene.height) =
                place(scene.crop_window.whole_height, stratum / strata, place_height, random);
            const Comparison found = compare(drawn(*film_, scene), drawn(*truth_, by_short_steps(scene)));
            differing += static_cast<double>(found.visibly_differing);
            pixels += static_cast<double>(found.pixels);
        }
        return 100 * differing / pixels;
    }

private:
    // Chooses the position of a patch along one side of the frame, at random within cell number `stratum`. Returns the
    // patch's first pixel and its length in pixels.
    static std::pair<int, int> place(int side, int stratum, int pixels, FlightRandom& random)
    {
        const int begin = side * stratum / strata;
        const int room = side * (stratum + 1) / strata - begin;
        const int length = std::max(1, std::min(pixels, room));
        const auto spare = static_cast<std::uint64_t>(std::max(0, room - length)) + 1;
        return {std::min(begin, side - length) + static_cast<int>(random.next() % spare), length};
    }

    static Image drawn(Renderer& renderer, const Scene& scene)
    {
        Image image(scene.width, scene.height, Image::Layers::bytes);
        renderer.render(scene, image);
        return image;
    }

    FrameScenes scenes_;
    std::unique_ptr<Renderer> film_, truth_;
};

}  // namespace

std::vector<Row> truth_rows(const Path& path, const Backend& backend, const RendererOptions& options,
                            const Picture& picture)
{
    std::vector<double> offs((path.frames.size() + every - 1) / every);
    // A patch has too few rays to occupy several threads. Therefore the threads compare different frames.
    const bool many = backend.info().concurrent;
    RendererOptions own = options;
    if (many) own.threads = 1;
    parallel(offs.size(), 2, many ? options.threads : 1, [&](std::size_t first, std::size_t last) {
        const Comparer comparer(path, backend, own, picture);
        for (std::size_t i = first; i < last; ++i) offs[i] = comparer.off(i * every);
    });
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(offs) - offs.begin());
    const auto row = [](const char* name, double value, double bar, std::optional<std::size_t> frame = {}) {
        return Row{name, value, bar, true, true, "%", frame};
    };
    return {row("pixels off their converged picture, median frame", quantile(offs, 0.5), median_bar),
            row("pixels off their converged picture, 95 of 100 frames", quantile(offs, 0.95), most_frames_bar),
            row("pixels off their converged picture, worst frame", offs[worst], worst_bar, worst * every)};
}

}  // namespace mandelmarch
