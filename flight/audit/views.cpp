// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text/quantile.h"
#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

// The limits of Dullness.
constexpr double least_hits = 0.15;  // fraction of the pixels
constexpr double one_depth = 1.25;   // ratio of the depths between which 95 % of the pixels lie
constexpr double near_wall = 2;      // clearances
constexpr double filling = 0.9;      // fraction of the pixels

constexpr double coarse = 0.008;  // hit tolerance, as a fraction of the ray's length so far

Camera camera_at(const Frame& frame) { return camera_of(scene_of({}, frame, 16, 9)); }

// A position in a view. Both coordinates run from -1 to 1 over the view's width and height.
struct ViewPoint {
    double u, v;
};

// Returns the centre of a pixel.
ViewPoint place_of(int pixel)
{
    const int row = pixel / view_width;
    return {(2 * (pixel % view_width) + 1.0) / view_width - 1, (2 * row + 1.0) / view_height - 1};
}

constexpr double same_view = 0.95;  // two views with a larger correlation count as the same
constexpr double moved_on = 0.5;    // two views with a smaller correlation count as different
constexpr double minute = 60;       // seconds
constexpr double much_sky = 0.4;    // a view with a smaller fraction of hit pixels mostly shows the background
constexpr double shown = 0.05;      // with a smaller fraction of hits in the centre, the fractal is only at the edge
constexpr double view_every = 0.5;  // seconds between the views compared for repetition

// Returns an item whose value is the longest time, in seconds, during which is(v) is true for all views v. Frames
// without a view, next to one of these views, are part of that time.
template <class Is>
Row longest_row(const char* name, double bar, const Seen& seen, std::size_t stride, Is is)
{
    std::size_t longest = 0;
    std::size_t where = 0;
    std::size_t on_end = 0;
    for (std::size_t v = 0; v < seen.views.size(); ++v) {
        on_end = is(v) ? on_end + 1 : 0;
        if (on_end > longest) {
            longest = on_end;
            where = seen.frames[v + 1 - on_end];
        }
    }
    const std::size_t frames = longest > 0 ? (longest + 1) * stride - 1 : 0;
    const double seconds = static_cast<double>(frames) / seen.frames_per_second;
    return {name, seconds, bar, true, false, "s", longest > 0 ? std::optional(where) : std::nullopt};
}

}  // namespace

Vector direction_of(const Camera& camera, int pixel)
{
    const ViewPoint place = place_of(pixel);
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
    const auto at = [&](double share) { return static_cast<double>(quantile(depth, share)); };
    if (at(filling) < near_wall * clearance) return Dullness::wall;
    return at(0.975) < one_depth * at(0.025) ? Dullness::one_depth : Dullness::lively;
}

std::vector<DepthView> views_of(const DistanceField& field, std::span<const Frame> frames)
{
    std::vector<Vector> from;
    std::vector<Vector> along;
    for (const Frame& frame : frames) {
        const Camera camera = camera_at(frame);
        from.insert(from.end(), view_pixels, frame.eye);
        for (int k = 0; k < view_pixels; ++k) along.push_back(direction_of(camera, k));
    }
    std::vector<double> t(from.size());
    const double end = farthest_seen * field.bounds().size;
    field.casts(from, along, {.floor = 0, .tolerance = coarse, .end = end, .steps = most_steps}, t);
    std::vector<DepthView> views(frames.size());
    for (std::size_t i = 0; i < t.size(); ++i) {
        views[i / view_pixels].depth[i % view_pixels] =
            t[i] < end ? static_cast<float>(t[i]) : std::numeric_limits<float>::infinity();
    }
    return views;
}

DepthView view_of(const DistanceField& field, const Frame& frame) { return views_of(field, {&frame, 1}).front(); }

double median_motion(std::span<const Vector> along, std::span<const float> depths, const Frame& from, const Frame& to)
{
    const Camera before = camera_at(from);
    const Camera after = camera_at(to);
    // Projects a direction into the camera's picture.
    const auto place_in = [](const Camera& camera, Vector seen) {
        const double ahead = dot(seen, camera.forward);
        return ViewPoint{dot(seen, camera.across) / (dot(camera.across, camera.across) * ahead),
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
    return moved.empty() ? 0 : upper_median(moved);
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

LogDepths::LogDepths(const DepthView& view) : values{}, squares(0)
{
    float most = 0;
    for (const float d : view.depth) most = std::isfinite(d) ? std::max(most, d) : most;
    double mean = 0;
    for (std::size_t k = 0; k < view_pixels; ++k) {
        values[k] = std::log(static_cast<double>(std::isfinite(view.depth[k]) ? view.depth[k] : 2 * most) + 1e-12);
        mean += values[k] / view_pixels;
    }
    for (double& value : values) {
        value -= mean;
        squares += value * value;
    }
}

double likeness(const LogDepths& a, const LogDepths& b)
{
    double same = 0;
    double mirrored = 0;
    for (std::size_t k = 0; k < view_pixels; ++k) {
        const std::size_t m = k / view_width * view_width + view_width - 1 - k % view_width;
        same += a.values[k] * b.values[k];
        mirrored += a.values[k] * b.values[m];
    }
    const double scale = std::sqrt(a.squares * b.squares);
    // If a view has constant depth, its correlation with another view is undefined. Two views of constant depth count
    // as equal (1). A view of constant depth and any other view count as unlike (0).
    return scale > 0 ? std::max(same, mirrored) / scale : a.squares == b.squares ? 1 : 0;
}

Row motion_row(const Path& path, const Seen& seen, int threads)
{
    // The last frame of the path has no motion.
    const auto known = std::ranges::lower_bound(seen.frames, path.frames.size() - 1) - seen.frames.begin();
    std::vector<double> moved(static_cast<std::size_t>(known));
    parallel(moved.size(), 16, threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v) {
            const auto frame = path.frames.begin() + static_cast<std::ptrdiff_t>(seen.frames[v]);
            moved[v] = median_motion(seen.views[v], frame[0], frame[1]);
        }
    });
    if (moved.empty()) moved.push_back(0);
    const double median = upper_median(moved);
    const auto fine = std::ranges::count_if(moved, [&](double m) { return m >= median / 3 && m <= 3 * median; });
    return {"frames with apparent motion within 3 times its median",
            100.0 * static_cast<double>(fine) / static_cast<double>(moved.size()),
            95,
            false,
            false,
            "%",
            {},
            fmt::format("median {:.2f} % of the height a frame", 100 * median)};
}

std::vector<Row> dull_rows(const Seen& seen, std::span<const double> clearances, std::size_t stride, int threads)
{
    std::vector<Dullness> dullness(seen.views.size());
    parallel(dullness.size(), 64, threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v) dullness[v] = seen.views[v].dullness(clearances[seen.frames[v]]);
    });
    const auto share = [&](Dullness kind) {
        return 100.0 * static_cast<double>(std::ranges::count(dullness, kind)) / static_cast<double>(dullness.size());
    };
    const double dull = share(Dullness::empty) + share(Dullness::one_depth) + share(Dullness::wall);
    const std::string why = dull > 0
                                ? fmt::format("empty {:.1f} %, one depth {:.1f} %, a wall {:.1f} %",
                                              share(Dullness::empty), share(Dullness::one_depth), share(Dullness::wall))
                                : "";
    return {{"dull frames", dull, 3, true, false, "%", {}, why},
            longest_row("longest time of dull frames on end", 1, seen, stride,
                        [&](std::size_t v) { return dullness[v] != Dullness::lively; })};
}

std::vector<Row> subject_rows(const Seen& seen, std::size_t stride)
{
    const auto sky =
        std::ranges::count_if(seen.views, [](const DepthView& view) { return view.hit_share() < much_sky; });
    const double share = 100.0 * static_cast<double>(sky) / static_cast<double>(seen.views.size());
    return {{"frames under 40 % of which something is hit", share, 10, true, false, "%"},
            longest_row("longest time with the subject at the edge only", 2, seen, stride,
                        [&](std::size_t v) { return seen.views[v].middle_hit_share() < shown; })};
}

std::vector<Repeated> repeated_views(const Seen& seen, int threads)
{
    std::vector<std::size_t> some;  // indices of the compared views
    std::vector<LogDepths> depths;
    const auto every = static_cast<std::size_t>(view_every * seen.frames_per_second);
    for (std::size_t v = 0; v < seen.views.size(); ++v) {
        if (!some.empty() && seen.frames[v] < seen.frames[some.back()] + every) continue;
        some.push_back(v);
        depths.emplace_back(seen.views[v]);
    }
    const auto frame = [&](std::size_t i) { return seen.frames[some[i]]; };
    std::vector<std::size_t> later(some.size(), 0);  // for each view: its first repetition; 0: none
    parallel(some.size(), 16, threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            bool other = false;  // a view that differs from view i lies between i and j
            for (std::size_t j = i + 1; j < some.size() && later[i] == 0 &&
                                        static_cast<double>(frame(j) - frame(i)) <= minute * seen.frames_per_second;
                 ++j) {
                const double like = likeness(depths[i], depths[j]);
                other = other || like < moved_on;
                if (other && like > same_view) later[i] = j;
            }
        }
    });
    std::vector<Repeated> repeated;
    for (std::size_t i = 0; i < some.size(); ++i) {
        if (later[i] > 0) repeated.push_back({frame(i), frame(later[i])});
    }
    return repeated;
}

}  // namespace mandelmarch
