// SPDX-License-Identifier: Apache-2.0
#include "bench/views.h"

#include <string>

#include "bench/official_scenes.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch::bench {
namespace {

void look_from(Scene& scene, Vector eye, Vector target, Vector up)
{
    scene.eye = eye;
    scene.target = target;
    scene.up = up;
    scene.field_of_view = 1;
}

}  // namespace

Scene official_scene_of(std::string_view nickname, int width, int height)
{
    Scene scene = parse_parameters(official_parameters(nickname), std::string(nickname), fractal_named(nickname)).scene;
    scene.width = width;
    scene.height = height;
    return scene;
}

std::vector<View> views_of(std::string_view nickname, int width, int height)
{
    const Scene official = official_scene_of(nickname, width, height);
    std::vector<View> views{
        {"official", official}, {"near", official}, {"far", official}, {"coarse", official}, {"close", official}};
    views[1].scene.eye = 0.75 * official.eye;
    views[2].scene.eye = 3.0 * official.eye;
    views[3].scene.detail = -2;
    // All surface, chosen by hand by the iterations of fast mode at 270 x 270: of 300 random places right before the
    // surface and away from the poles the dearest (bulb); of 600 the dearest in which float and double agree (box). Why
    // not every place will do: docs/fast-mode.md, "What fast mode misses".
    if (nickname == "bulb")
        look_from(views[4].scene, {-0.3174, 0.4074, 0.4757}, {0.9284, -0.7791, -0.2418}, {0.3966, 1.1637, -0.8952});
    if (nickname == "box")
        look_from(views[4].scene, {-3.9894, -6.8023, -3.3053}, {-4.1580, -5.8145, -3.6158}, {1.3852, 0.8119, 1.3542});
    if (nickname == "bulb") {
        // A power that is not whole is raised through angles; the picture is all but the official one.
        views.push_back({"angles", official});
        views.back().scene.shape[2] += 1e-5;
    }
    return views;
}

}  // namespace mandelmarch::bench
