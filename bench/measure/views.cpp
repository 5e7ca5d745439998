// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/views.h"

#include <algorithm>

#include "core/scene/parameter_file.h"

namespace mandelmarch::bench {
namespace {

// The close-ups come from random cameras close to the surface, 600 for the Mandelbox and 300 for the Mandelbulb. Among
// the views with the most iterations (fast mode, 270 x 270), one was selected by hand. Not every view is suitable
// (docs/fast-mode.md, "What fast mode misses"). In the selected ones, the Mandelbox's pictures in float and double
// agree, and the Mandelbulb's camera is away from the poles.
constexpr std::array box_iterations{4, 8, 12, 18, 30, 60};
constexpr FractalStudy entries[] = {
    {.fractal = "mandelbox",
     .iterations = box_iterations,
     .close_up =
         FractalStudy::CloseUp{{-3.9894, -6.8023, -3.3053}, {-4.1580, -5.8145, -3.6158}, {1.3852, 0.8119, 1.3542}}},
    // With a power that is not an integer, the kernel computes z^P with trigonometric functions. The power differs so
    // little from the official one that the pictures are nearly equal. In some pixels the picture depends on the last
    // bit of these functions.
    {.fractal = "mandelbulb",
     .close_up =
         FractalStudy::CloseUp{{-0.3174, 0.4074, 0.4757}, {0.9284, -0.7791, -0.2418}, {0.3966, 1.1637, -0.8952}},
     .variant = FractalStudy::Variant{"angles", {0, 0, 1e-5}}},
};

void look_from(Scene& scene, const FractalStudy::CloseUp& look)
{
    scene.eye = look.eye;
    scene.target = look.target;
    scene.up = look.up;
    scene.field_of_view = 1;
}

}  // namespace

const FractalStudy& study_of(const Fractal& fractal)
{
    static constexpr FractalStudy usual{};
    const auto* const entry = std::ranges::find(entries, fractal.name, &FractalStudy::fractal);
    return entry == std::end(entries) ? usual : *entry;
}

std::vector<const Fractal*> default_fractals()
{
    std::vector<const Fractal*> all;
    std::vector<const Fractal*> known;
    for (const Fractal& fractal : fractals()) {
        all.push_back(&fractal);
        if (!study_of(fractal).fractal.empty()) known.push_back(&fractal);
    }
    return known.empty() ? all : known;
}

std::vector<View> views_of(std::string_view short_name, int width, int height)
{
    const Scene official = official_scene(fractal_named(short_name), width, height);
    std::vector<View> views{{"official", official}, {"near", official}, {"far", official}, {"coarse", official}};
    views[1].scene.eye = 0.75 * official.eye;
    views[2].scene.eye = 3.0 * official.eye;
    views[3].scene.detail = -2;
    const FractalStudy& study = study_of(*official.fractal);
    if (study.close_up) {
        views.push_back({"close", official});
        look_from(views.back().scene, *study.close_up);
    }
    if (study.variant) {
        views.push_back({study.variant->name, official});
        for (std::size_t i = 0; i < official.shape.size(); ++i) views.back().scene.shape[i] += study.variant->added[i];
    }
    return views;
}

}  // namespace mandelmarch::bench
