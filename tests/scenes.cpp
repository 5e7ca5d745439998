#include "tests/scenes.h"

#include <fstream>
#include <iterator>

#include "core/scene/fractal.h"

namespace mandelmarch {

std::string official_text(const std::string& nickname)
{
    const std::string name = nickname == "bulb" ? "paramsBulb.dat" : "paramsBox.dat";
    std::ifstream file(std::string(MANDELMARCH_SOURCE_DIR) + "/" + name);
    return {std::istreambuf_iterator<char>(file), {}};
}

Scene official_scene(const std::string& nickname, int width, int height)
{
    Scene scene = parse_parameters(official_text(nickname), nickname, fractal_named(nickname)).scene;
    scene.width = width;
    scene.height = height;
    return scene;
}

std::vector<NamedScene> odd_scenes()
{
    const Scene bulb = official_scene("bulb", 47, 33);
    const Scene box = official_scene("box", 47, 33);
    std::vector<NamedScene> scenes;
    const auto add = [&](std::string name, const Scene& scene) -> Scene& {
        return scenes.emplace_back(NamedScene{std::move(name), scene}).scene;
    };
    add("bulb, power 2", bulb).shape[2] = 2;
    add("bulb, power 9", bulb).shape[2] = 9;
    add("bulb, power 7.5", bulb).shape[2] = 7.5;
    add("bulb, power 1", bulb).shape[2] = 1;
    add("bulb, colouring 0", bulb).colouring = 0;
    add("bulb, few iterations", bulb).iterations = 1;
    add("bulb, camera inside", bulb).eye = {0.1, 0.2, 0.1};
    add("bulb, on the axis", bulb).eye = {0, 0, 2.5};
    scenes.back().scene.up = {1, 0, 0};
    add("bulb, up along z", bulb).up = {0, 0, 1};
    add("box, scale -1.5", box).shape[0] = -1.5;
    add("box, scale 3", box).shape[0] = 3;
    add("box, other radii", box).shape = {2, 0.25, 1.5};
    add("box, oblique up", box).up = {0.3, -1, 0.7};
    add("box, camera inside", box).eye = {0.5, 0.5, 0.5};
    add("box, four iterations", box).iterations = 4;
    add("box, one column", box).width = 1;
    return scenes;
}

Image render(const Backend& backend, const Scene& scene, const RendererOptions& options)
{
    Image image(scene.width, scene.height, Image::Layers::all);
    backend.create(options)->render(scene, image);
    return image;
}

}  // namespace mandelmarch
