// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/view_rows.h"

#include <fmt/format.h>

#include <algorithm>

namespace mandelmarch {
namespace {

constexpr double same_view = 0.95;  // two views with a larger correlation are the same
constexpr double moved_on = 0.5;    // two views with a smaller correlation differ
constexpr double minute = 60;       // seconds
constexpr double much_sky = 0.4;    // a view with a smaller fraction of hit pixels mostly shows the background
constexpr double shown = 0.05;      // with a smaller fraction of hits in the centre, the fractal is only at the edge
constexpr double view_every = 0.5;  // seconds between the views compared for repetition

// Returns an item whose value is the longest time, in seconds, during which is(v) is true for all views v.
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
    const double seconds = static_cast<double>(longest * stride) / seen.frames_per_second;
    return {name, seconds, bar, true, false, "s", longest > 0 ? at_frame(where) : ""};
}

}  // namespace

std::string at_frame(std::size_t frame) { return fmt::format("frame {}", frame); }

Row motion_row(const Path& path, const Seen& seen)
{
    std::vector<double> moved;
    for (std::size_t v = 0; v < seen.views.size(); ++v) {
        const std::size_t frame = seen.frames[v];
        if (frame + 1 >= path.frames.size()) break;
        moved.push_back(median_motion(seen.views[v], path.frames[frame], path.frames[frame + 1]));
    }
    if (moved.empty()) moved.push_back(0);
    std::vector<double> sorted = moved;
    std::ranges::sort(sorted);
    const double median = sorted[sorted.size() / 2];
    const auto fine = std::ranges::count_if(moved, [&](double m) { return m >= median / 3 && m <= 3 * median; });
    return {"frames with apparent motion within 3 times its median",
            100.0 * static_cast<double>(fine) / static_cast<double>(moved.size()),
            95,
            false,
            false,
            "%",
            fmt::format("median {:.2f} % of the height a frame", 100 * median)};
}

std::vector<Row> dull_rows(const Seen& seen, std::span<const double> clearances, std::size_t stride)
{
    std::vector<Dullness> dullness;
    for (std::size_t v = 0; v < seen.views.size(); ++v)
        dullness.push_back(seen.views[v].dullness(clearances[seen.frames[v]]));
    const auto share = [&](Dullness kind) {
        return 100.0 * static_cast<double>(std::ranges::count(dullness, kind)) / static_cast<double>(dullness.size());
    };
    const double dull = share(Dullness::empty) + share(Dullness::one_depth) + share(Dullness::wall);
    const std::string why = dull > 0
                                ? fmt::format("empty {:.1f} %, one depth {:.1f} %, a wall {:.1f} %",
                                              share(Dullness::empty), share(Dullness::one_depth), share(Dullness::wall))
                                : "";
    return {{"dull frames", dull, 3, true, false, "%", why},
            longest_row("longest time of dull frames on end", 1, seen, stride,
                        [&](std::size_t v) { return dullness[v] != Dullness::lively; })};
}

std::vector<Row> subject_rows(const Seen& seen, std::size_t stride)
{
    const auto sky =
        std::ranges::count_if(seen.views, [](const DepthView& view) { return view.hit_share() < much_sky; });
    const double share = 100.0 * static_cast<double>(sky) / static_cast<double>(seen.views.size());
    return {{"frames under 40 % of which something is hit", share, 10, true, false, "%", ""},
            longest_row("longest time with the subject at the edge only", 2, seen, stride,
                        [&](std::size_t v) { return seen.views[v].middle_hit_share() < shown; })};
}

Row again_row(const Seen& seen)
{
    std::vector<std::size_t> some;  // indices of the compared views
    const auto every = static_cast<std::size_t>(view_every * seen.frames_per_second);
    for (std::size_t v = 0; v < seen.views.size(); ++v) {
        if (some.empty() || seen.frames[v] >= seen.frames[some.back()] + every) some.push_back(v);
    }
    const auto frame = [&](std::size_t i) { return seen.frames[some[i]]; };
    std::size_t again = 0;
    std::string first;
    for (std::size_t i = 0; i < some.size(); ++i) {
        bool other = false;  // a view that differs from view i lies between i and j
        for (std::size_t j = i + 1;
             j < some.size() && static_cast<double>(frame(j) - frame(i)) <= minute * seen.frames_per_second; ++j) {
            const double like = likeness(seen.views[some[i]], seen.views[some[j]]);
            other = other || like < moved_on;
            if (!other || like <= same_view) continue;
            if (again++ == 0) first = fmt::format("frames {} and {}", frame(i), frame(j));
            break;
        }
    }
    return {"the same view again within a minute", static_cast<double>(again), 0, true, false, "", first};
}

}  // namespace mandelmarch
