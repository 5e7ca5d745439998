// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mandelmarch {
namespace {

// The limits of Dullness.
constexpr double least_hits = 0.15;  // fraction of the pixels
constexpr double one_depth = 1.25;   // ratio of the depths between which 95 % of the pixels lie
constexpr double near_wall = 2;      // clearances
constexpr double filling = 0.9;      // fraction of the pixels

constexpr double far = 12;        // fractal sizes; largest length of a ray
constexpr double coarse = 0.008;  // hit tolerance, as a fraction of the ray's length so far

Camera camera_at(const Frame& frame)
{
    Scene scene;
    scene.eye = frame.eye;
    scene.target = frame.target;
    scene.up = frame.up;
    scene.field_of_view = frame.field_of_view;
    scene.width = 16;
    scene.height = 9;
    return camera_of(scene);
}

// A position in a view. Both coordinates run from -1 to 1 over the view's width and height.
struct Place {
    double u, v;
};

// Returns the centre of a pixel.
Place place_of(int pixel)
{
    const int row = pixel / view_width;
    return {(2 * (pixel % view_width) + 1.0) / view_width - 1, (2 * row + 1.0) / view_height - 1};
}

}  // namespace

Vector direction_of(const Camera& camera, int pixel)
{
    const Place place = place_of(pixel);
    return unit(camera.forward + place.u * camera.across + place.v * camera.upward);
}

double DepthView::hit_share() const
{
    const auto hits = std::ranges::count_if(depth, [](float d) { return std::isfinite(d); });
    return static_cast<double>(hits) / view_pixels;
}

double DepthView::middle_hit_share() const
{
    int pixels = 0;
    int hits = 0;
    for (int k = 0; k < view_pixels; ++k) {
        const auto [u, v] = place_of(k);
        if (std::abs(u) > 0.75 || std::abs(v) > 0.75) continue;
        ++pixels;
        hits += std::isfinite(depth[static_cast<std::size_t>(k)]) ? 1 : 0;
    }
    return static_cast<double>(hits) / pixels;
}

Dullness DepthView::dullness(double clearance) const
{
    if (hit_share() < least_hits) return Dullness::empty;
    std::array<float, view_pixels> sorted = depth;
    std::ranges::sort(sorted);
    const auto at = [&](double share) {
        return static_cast<double>(sorted[static_cast<std::size_t>(share * (view_pixels - 1))]);
    };
    if (at(filling) < near_wall * clearance) return Dullness::wall;
    return at(0.975) < one_depth * at(0.025) ? Dullness::one_depth : Dullness::lively;
}

DepthView view_of(const DistanceField& field, const Frame& frame)
{
    const Camera camera = camera_at(frame);
    const std::vector<Vector> from(view_pixels, frame.eye);
    std::vector<Vector> along;
    for (int k = 0; k < view_pixels; ++k) along.push_back(direction_of(camera, k));
    std::vector<double> t(view_pixels);
    const double end = far * field.bounds().size;
    field.casts(from, along, {.floor = 0, .tolerance = coarse, .end = end, .steps = 90}, t);
    DepthView view;
    std::ranges::transform(t, view.depth.begin(), [end](double depth) {
        return depth < end ? static_cast<float>(depth) : std::numeric_limits<float>::infinity();
    });
    return view;
}

double median_motion(std::span<const Vector> along, std::span<const float> depths, const Frame& from, const Frame& to)
{
    const Camera before = camera_at(from);
    const Camera after = camera_at(to);
    // Projects a direction into the camera's picture.
    const auto place_in = [](const Camera& camera, Vector seen) {
        const double ahead = dot(seen, camera.forward);
        return Place{dot(seen, camera.across) / (dot(camera.across, camera.across) * ahead),
                     dot(seen, camera.upward) / (dot(camera.upward, camera.upward) * ahead)};
    };
    std::vector<double> moved;
    for (std::size_t k = 0; k < along.size(); ++k) {
        // The background is treated as infinitely far away, so that only the camera's rotation moves it.
        const Vector seen_after =
            std::isfinite(depths[k]) ? from.eye + static_cast<double>(depths[k]) * along[k] - to.eye : along[k];
        if (!(dot(seen_after, after.forward) > 0)) {
            moved.push_back(1);
            continue;
        }
        const auto [u, v] = place_in(before, along[k]);
        const auto [u2, v2] = place_in(after, seen_after);
        moved.push_back(0.5 * std::hypot((u2 - u) * view_width / view_height, v2 - v));
    }
    if (moved.empty()) return 0;
    const auto middle = moved.begin() + static_cast<std::ptrdiff_t>(moved.size() / 2);
    std::ranges::nth_element(moved, middle);
    return *middle;
}

double median_motion(const DepthView& seen, const Frame& from, const Frame& to)
{
    const Camera camera = camera_at(from);
    const bool hits_only = seen.hit_share() > 0.02;
    std::vector<Vector> along;
    std::vector<float> depths;
    for (int k = 0; k < view_pixels; ++k) {
        const float depth = seen.depth[static_cast<std::size_t>(k)];
        if (hits_only && !std::isfinite(depth)) continue;
        along.push_back(direction_of(camera, k));
        depths.push_back(depth);
    }
    return median_motion(along, depths, from, to);
}

double likeness(const DepthView& a, const DepthView& b)
{
    // Pixels of the background are treated as twice as far away as the farthest hit.
    const auto logarithms = [](const DepthView& view) {
        float most = 0;
        for (const float d : view.depth) most = std::isfinite(d) ? std::max(most, d) : most;
        std::array<double, view_pixels> logs{};
        double mean = 0;
        for (std::size_t k = 0; k < view_pixels; ++k) {
            logs[k] = std::log(static_cast<double>(std::isfinite(view.depth[k]) ? view.depth[k] : 2 * most) + 1e-12);
            mean += logs[k] / view_pixels;
        }
        for (double& l : logs) l -= mean;
        return logs;
    };
    const auto x = logarithms(a);
    const auto y = logarithms(b);
    double xx = 0;
    double yy = 0;
    double xy = 0;
    double mirrored = 0;
    for (int k = 0; k < view_pixels; ++k) {
        const auto n = static_cast<std::size_t>(k);
        const auto m = static_cast<std::size_t>(k / view_width * view_width + view_width - 1 - k % view_width);
        xx += x[n] * x[n];
        yy += y[n] * y[n];
        xy += x[n] * y[n];
        mirrored += x[n] * y[m];
    }
    const double scale = std::sqrt(xx * yy);
    // The correlation with a view of constant depth is undefined. Such a view counts as equal to another one of
    // constant depth, and as unlike all others.
    return scale > 0 ? std::max(xy, mirrored) / scale : xx == yy ? 1 : 0;
}

}  // namespace mandelmarch
