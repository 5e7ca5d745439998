// SPDX-License-Identifier: Apache-2.0
// The plan that flythrough's options describe, and its map.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>

#include "apps/flythrough_options.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"
#include "core/text/version.h"
#include "flight/field/field.h"
#include "flight/path/places.h"

namespace mandelmarch {
namespace {

// Prints the first line of the planner's message to stderr. The other lines, a table of the tour's audit, are left out.
void log_plan(const std::string& text) { say("plan: {}\n", text.substr(0, text.find('\n'))); }

// Returns the schedule by which the fractal changes in flight, from --power or --scale. Throws InputError if the shape
// cannot be flown through.
Schedule schedule_of(const Flythrough& options, const PlanOptions& plan)
{
    if (!options.power.empty() && !options.scale.empty()) {
        throw InputError("--power, --scale: both are given, expected the one that the fractal has");
    }
    if (!options.power.empty()) return parse_schedule("power", options.power, plan.scene, plan.frames);
    if (!options.scale.empty()) return parse_schedule("scale", options.scale, plan.scene, plan.frames);
    const std::string objection = flight_objection(plan.scene);
    if (objection.empty()) return {};
    throw InputError(options.parameters.empty() ? objection : fmt::format("{}: {}", options.parameters, objection));
}

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

PlanOptions read_plan(const Flythrough& options)
{
    PlanOptions plan = options.plan;
    const Fractal& fractal = fractal_named(options.fractal);
    plan.scene = official_scene(fractal, 16, 9);
    if (!options.parameters.empty()) {
        const ParameterFile file = read_parameters(options.parameters, fractal);
        for (const std::string& warning : file.warnings) say("{}\n", printable(warning));
        plan.scene = file.scene;
    }
    plan.scene.colouring = options.film.picture.look.value_or(ChosenLook{}).colouring;
    plan.scene.conservative = options.conservative;
    // Flights are planned at frames_per_second and then converted to --fps.
    plan.frames = std::max(2, frames_at_rate(options.frames, frames_per_second, options.rate));
    plan.schedule = schedule_of(options, plan);
    plan.log = log_plan;
    if (!options.places.empty()) plan.places = read_places(options.places);
    return plan;
}

Plan make_plan(const Flythrough& options)
{
    Plan made = plan(options.plan);
    // A flight that ends at a place can be shorter.
    made.path = at_rate(made.path, options.frames, options.rate);
    return made;
}

std::string map_of(const Plan& made, int threads)
{
    const auto& [path, seconds, attempts, balls, gates] = made;
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
