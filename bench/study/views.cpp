// SPDX-License-Identifier: Apache-2.0
#include "bench/study/views.h"

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch::bench {
namespace {

void look_from(Scene& scene, const FractalStudy::CloseUp& look)
{
    scene.eye = look.eye;
    scene.target = look.target;
    scene.up = look.up;
    scene.field_of_view = 1;
}

}  // namespace

std::vector<View> views_of(std::string_view short_name, int width, int height)
{
    const Scene official = official_scene(fractal_named(short_name), width, height);
    std::vector<View> views{{"official", official}, {"near", official}, {"far", official}, {"coarse", official}};
    views[1].scene.eye = 0.75 * official.eye;
    views[2].scene.eye = 3.0 * official.eye;
    views[3].scene.detail = -2;
    const FractalStudy& study = official.fractal->study;
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
