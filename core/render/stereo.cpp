// SPDX-License-Identifier: Apache-2.0
#include "core/render/stereo.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/render/kernel_scene.h"

namespace mandelmarch {
namespace {

void put(const Image& half, int left, Image& image)
{
    const auto width = static_cast<std::ptrdiff_t>(half.width());
    for (int y = 0; y < half.height(); ++y) {
        const std::ptrdiff_t from = y * width;
        const std::ptrdiff_t to = std::ptrdiff_t{y} * image.width() + left;
        std::copy_n(half.bytes().begin() + 3 * from, 3 * width, image.bytes().begin() + 3 * to);
        if (half.has_values()) std::copy_n(half.values().begin() + from, width, image.values().begin() + to);
    }
}

}  // namespace

Scene of_eye(const Scene& scene, double eyes, int side)
{
    Scene eye = scene;
    eye.width = scene.width / 2;
    const Camera camera = camera_of(eye);
    const Vector moved = (side * eyes / 2) * unit(camera.across);
    eye.eye = scene.eye + moved;
    eye.target = scene.target + moved;
    // Half of the parallax of the screen, in pixels; the window moves in the opposite direction.
    const double half_width = std::sqrt(dot(camera.across, camera.across));
    const auto shift = static_cast<int>(std::lround(eye.width / (4 * screen_distance * half_width)));
    eye.part = {.left = side < 0 ? 2 * shift : 0, .whole_width = eye.width + 2 * shift, .whole_height = eye.height};
    return eye;
}

RenderReport render_stereo(Renderer& renderer, const Scene& scene, double eyes, Image& image, const Progress& progress)
{
    if (scene.width % 2 != 0) throw InputError("a picture for two eyes: its width is odd, expected an even one");
    if (scene.part.whole_width > 0 || scene.projection != Projection::perspective) {
        throw InputError("a picture for two eyes: expected a whole perspective one");
    }
    const auto layers = image.has_depths()   ? Image::Layers::all
                        : image.has_values() ? Image::Layers::colours
                                             : Image::Layers::bytes;
    Image half(scene.width / 2, scene.height, layers);
    RenderReport report;
    for (const int side : {-1, 1}) {
        const RenderReport one = renderer.render(of_eye(scene, eyes, side), half, [&](double share) {
            if (progress) progress((side < 0 ? 0 : 0.5) + 0.5 * share);
        });
        put(half, side < 0 ? 0 : half.width(), image);
        if (side < 0) {
            report = one;
        } else {
            report.timings += one.timings;
            report.work += one.work;
            report.stride = std::min(report.stride, one.stride);
            report.unsettled = std::max(report.unsettled, one.unsettled);
        }
    }
    return report;
}

}  // namespace mandelmarch
