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
    // The dearest of every 30th frame of a film, seed 1: all surface.
    if (nickname == "bulb")
        look_from(views[4].scene, {0.1061, -0.1069, -0.8585}, {-0.6317, 0.5252, -0.6216}, {0.5395, 0.7630, -0.3560});
    if (nickname == "box")
        look_from(views[4].scene, {5.5284, 5.4978, 0.8878}, {4.6079, 5.7532, 1.1835}, {0.1766, 0.9470, -0.2683});
    if (nickname == "bulb") {
        // A power that is not whole is raised through angles; the picture is all but the official one.
        views.push_back({"angles", official});
        views.back().scene.shape[2] += 1e-5;
    }
    return views;
}

}  // namespace mandelmarch::bench
