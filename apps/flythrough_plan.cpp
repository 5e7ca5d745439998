// SPDX-License-Identifier: Apache-2.0
// The plan that flythrough's options describe.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "apps/flythrough_options.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
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
    const int wanted = options.plan.frames;
    const auto flown = static_cast<int>(made.path.frames.size());
    const int frames = flown < wanted ? (flown - 1) * options.rate / frames_per_second + 1 : options.frames;
    made.path = at_rate(made.path, frames, options.rate);
    return made;
}

}  // namespace mandelmarch
