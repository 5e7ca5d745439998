// SPDX-License-Identifier: Apache-2.0
#include "flight/route/map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/text/text.h"
#include "core/text/version.h"
#include "core/scene/fractal.h"
#include "flight/audit/audit.h"
#include "flight/audit/motion.h"

namespace mandelmarch {
namespace {

constexpr const char* format_name = "mandelmarch flight map 1";

// Limits that keep the file small. A drawing could not show more.
constexpr std::size_t most_balls = 2500;
constexpr std::size_t most_gates = 1000;
constexpr double beside = 0.12;        // fractal sizes; balls and gates farther from the path are left out
constexpr std::size_t path_every = 4;  // frames; positions in between are not compared with balls and gates

// Formats a number with five digits, which are enough for a drawing.
std::string number(double value) { return fmt::format("{:.5g}", value == 0 ? 0.0 : value); }

template <class Items, class Text>
std::string list(const Items& items, Text text_of)
{
    return fmt::format("[{}]", fmt::join(mapped(items, text_of), ","));
}

// Returns up to `most` balls as JSON, each as [x, y, z, clearance]. Balls that contain a point of the path come first,
// then balls near the path. Both groups are sorted by decreasing clearance.
std::string places(const Bounds& bounds, const std::vector<Vector>& path, std::vector<Ball> balls, std::size_t most)
{
    const auto away = [&](const Ball& ball) {
        double least = length(path.front() - ball.centre);
        for (std::size_t i = 0; i < path.size(); i += path_every)
            least = std::min(least, length(path[i] - ball.centre));
        return least;
    };
    std::vector<std::pair<bool, Ball>> found;
    for (const Ball& ball : balls) {
        const double least = bounds.contains(ball.centre) ? away(ball) : bounds.size;
        if (least < beside * bounds.size) found.emplace_back(least < ball.clearance, ball);
    }
    std::ranges::stable_sort(found, [](const auto& a, const auto& b) {
        return std::pair(a.first, a.second.clearance) > std::pair(b.first, b.second.clearance);
    });
    balls.clear();
    for (std::size_t i = 0; i < std::min(most, found.size()); ++i) balls.push_back(found[i].second);
    return list(balls, [](const Ball& ball) {
        return fmt::format("[{:.4g},{:.4g},{:.4g},{:.4g}]", ball.centre.x, ball.centre.y, ball.centre.z,
                           ball.clearance);
    });
}

}  // namespace

std::string map_of(const Path& path, const std::vector<Ball>& balls, const std::vector<Ball>& gates, int threads)
{
    const Runs runs(path, threads);
    const DistanceField& field = runs.field(0);
    const std::vector<Vector>& at = runs.places();
    const auto whole = [](const Passage& passage) { return std::to_string(passage.frame); };
    return fmt::format(
        "{{\n\"format\": \"{}\",\n\"program\": \"{}\",\n\"fractal\": \"{}\",\n\"seed\": {},\n\"frames_per_second\": "
        "{},\n"
        "\"hull\": {{\"shape\": \"{}\", \"size\": {}}},\n\"safety\": {},\n\"ball_count\": {},\n"
        "\"gate_count\": {},\n\"balls\": {},\n\"gates\": {},\n"
        "\"passages\": {},\n\"x\": {},\n\"y\": {},\n\"z\": {},\n\"clearance\": {},\n\"turn\": {}\n}}\n",
        format_name, version_line("flythrough"), path.scene.fractal->name, path.seed, path.frames_per_second,
        field.bounds().shape == Bounds::Shape::cube ? "cube" : "sphere", number(field.bounds().size),
        number(field.safety()), balls.size(), gates.size(), places(field.bounds(), at, balls, most_balls),
        places(field.bounds(), at, gates, most_gates), list(runs.passages(), whole),
        list(at, [](Vector v) { return number(v.x); }), list(at, [](Vector v) { return number(v.y); }),
        list(at, [](Vector v) { return number(v.z); }), list(runs.clearances(), number), list(turns_of(path), number));
}

}  // namespace mandelmarch
