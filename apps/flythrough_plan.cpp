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

// Returns the scene to fly through: that of the parameter file or, without one, the official scene. The scene's camera
// is not used. `warns`: true to print warnings about the file.
Scene scene_of(const Flythrough& options, bool warns = false)
{
    const Fractal& fractal = fractal_named(options.fractal);
    Scene scene = official_scene(fractal, 16, 9);
    if (!options.parameters.empty()) {
        const ParameterFile file = read_parameters(options.parameters, fractal);
        if (warns) {
            for (const std::string& warning : file.warnings) say("{}\n", printable(warning));
        }
        scene = file.scene;
    }
    scene.colouring = options.film.picture.look.value_or(ChosenLook{}).colouring;
    scene.conservative = options.conservative;
    return scene;
}

// Throws InputError if the scene's shape cannot be flown through.
void check_shape(const Flythrough& options, const Scene& scene)
{
    const std::string objection = flight_objection(scene);
    if (objection.empty()) return;
    throw InputError(options.parameters.empty() ? objection : fmt::format("{}: {}", options.parameters, objection));
}

// Prints the first line of the planner's message to stderr. The other lines, a table of the tour's audit, are left out.
void log_plan(const std::string& text) { say("plan: {}\n", text.substr(0, text.find('\n'))); }

// Returns the number of frames to plan. Flights are planned at frames_per_second and then converted to --fps.
int planned_frames(const Flythrough& options)
{
    return std::max(2, frames_at_rate(options.frames, frames_per_second, options.rate));
}

// Returns the schedule by which the fractal changes in flight, from --power or --scale. Throws InputError if the shape
// cannot be flown through.
Schedule schedule_of(const Flythrough& options)
{
    if (!options.power.empty() && !options.scale.empty()) {
        throw InputError("--power, --scale: both are given, expected the one that the fractal has");
    }
    const Scene scene = scene_of(options);
    const int frames = planned_frames(options);
    if (!options.power.empty()) return parse_schedule("power", options.power, scene, frames);
    if (!options.scale.empty()) return parse_schedule("scale", options.scale, scene, frames);
    check_shape(options, scene);
    return {};
}

// Returns the places that the flight visits; none without --places.
Places places_of(const Flythrough& options) { return options.places.empty() ? Places{} : read_places(options.places); }

}  // namespace

void check_plan(const Flythrough& options)
{
    static_cast<void>(scene_of(options, true));
    schedule_of(options);
    places_of(options);
}

Plan make_plan(const Flythrough& options)
{
    const int wanted = planned_frames(options);
    Plan made = plan({.scene = scene_of(options),
                      .schedule = schedule_of(options),
                      .seed = options.seed,
                      .frames = wanted,
                      .threads = options.threads,
                      .log = log_plan,
                      .places = places_of(options)});
    // A flight that ends at a place can be shorter.
    const auto flown = static_cast<int>(made.path.frames.size());
    const int frames = flown < wanted ? (flown - 1) * options.rate / frames_per_second + 1 : options.frames;
    made.path = at_rate(made.path, frames, options.rate);
    return made;
}

}  // namespace mandelmarch
