#include "flight/path/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mandelmarch {
namespace {

constexpr double footprint = 0.7;  // pixel heights
constexpr double degrees_per_field = 65;

}  // namespace

Scene scene_of(const Path& path, const Frame& frame, int width, int height)
{
    Scene scene = path.scene;
    scene.eye = frame.eye;
    scene.target = frame.target;
    scene.up = frame.up;
    scene.field_of_view = frame.field_of_view;
    scene.width = width;
    scene.height = height;
    const Changes& changes = frame.changes;
    if (changes.detail) {
        scene.detail = *changes.detail;
    } else if (path.detail_by_size) {
        const double tangent = std::tan(frame.field_of_view * degrees_per_field / 2 * std::numbers::pi / 180);
        scene.detail = static_cast<float>(std::clamp(std::log10(footprint * 2 * tangent / height), -6.0, -1.5));
    }
    if (changes.shape) scene.shape = *changes.shape;
    if (changes.iterations) scene.iterations = *changes.iterations;
    if (changes.escape) scene.escape = *changes.escape;
    if (changes.colouring) scene.colouring = *changes.colouring;
    if (changes.brightness) scene.brightness = *changes.brightness;
    return scene;
}

}  // namespace mandelmarch
