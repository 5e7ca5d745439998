// SPDX-License-Identifier: Apache-2.0
#include "core/render/stereo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/render/kernel_scene.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

// Copies `columns`, which has the height of the image, to the image's columns from `left` on.
void put(const Image& columns, int left, Image& image)
{
    const auto width = static_cast<std::ptrdiff_t>(columns.width());
    for (int y = 0; y < columns.height(); ++y) {
        const std::ptrdiff_t from = y * width;
        const std::ptrdiff_t to = std::ptrdiff_t{y} * image.width() + left;
        std::copy_n(columns.bytes().begin() + 3 * from, 3 * width, image.bytes().begin() + 3 * to);
        if (columns.has_values()) std::copy_n(columns.values().begin() + from, width, image.values().begin() + to);
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
    // Half of the screen's parallax, in pixels. The crop window of an eye moves in the direction opposite to the eye.
    const double half_width = std::sqrt(dot(camera.across, camera.across));
    const auto shift = static_cast<int>(std::lround(eye.width / (4 * screen_distance * half_width)));
    eye.crop_window = {
        .left = side < 0 ? 2 * shift : 0, .whole_width = eye.width + 2 * shift, .whole_height = eye.height};
    return eye;
}

Scene strip_of_eye(const Scene& scene, double eyes, int side, int left, int width)
{
    Scene strip = scene;
    const int whole_width = scene.width / 2;
    const double longitude = std::numbers::pi * ((2.0 * left + width) / whole_width - 1);
    const Camera camera = camera_of(scene);
    const Vector right = std::cos(longitude) * unit(camera.across) - std::sin(longitude) * camera.forward;
    const Vector moved = (side * eyes / 2) * right;
    strip.eye = scene.eye + moved;
    strip.target = scene.target + moved;
    strip.width = width;
    strip.crop_window = {.left = left, .whole_width = whole_width, .whole_height = scene.height};
    return strip;
}

RenderStats render_stereo(Renderer& renderer, const Scene& scene, double eyes, Image& image, const Progress& progress)
{
    if (scene.width % 2 != 0) throw InputError("a picture for two eyes: its width is odd, expected an even one");
    if (scene.crop_window.whole_width > 0) throw InputError("a picture for two eyes: expected a whole one");
    const int half = scene.width / 2;
    const bool panorama = scene.projection == Projection::equirectangular;
    const int width = panorama ? std::max(1, half / strips_around) : half;
    Image drawn;
    RenderStats report;
    for (int at = 0; at < scene.width; at += drawn.width()) {
        const int side = at < half ? -1 : 1;
        const int left = at % half;
        const int columns = std::min(width, half - left);
        if (drawn.width() != columns) drawn = Image(columns, scene.height, image.layers());
        const Scene crop_window = panorama ? strip_of_eye(scene, eyes, side, left, columns) : of_eye(scene, eyes, side);
        const RenderStats one = renderer.render(crop_window, drawn, [&](double share) {
            if (progress) progress((at + share * columns) / scene.width);
        });
        put(drawn, at, image);
        if (at == 0) {
            report = one;
        } else {
            report.timings += one.timings;
            report.work += one.work;
            report.step_factor = std::min(report.step_factor, one.step_factor);
            report.unsettled = std::max(report.unsettled, one.unsettled);
        }
    }
    return report;
}

}  // namespace mandelmarch
