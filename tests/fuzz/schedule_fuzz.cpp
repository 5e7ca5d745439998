// SPDX-License-Identifier: Apache-2.0
// Fuzzer: any bytes, read as the schedule of a shape parameter, give keyframes that increase and values in the
// parameter's range, or an InputError of one line.
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "flight/route/schedule.h"
#include "tests/fuzz/text.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    using namespace mandelmarch;
    constexpr int frames = 3600;
    return fuzz_text(data, size, "--", [](std::string_view text) {
        const bool power = text.starts_with('p');
        const Fractal& fractal = fractal_named(power ? "bulb" : "box");
        const Scene scene = official_scene(fractal, 16, 9);
        const Schedule schedule =
            parse_schedule(power ? "power" : "scale", std::string(text.substr(power ? 1 : 0)), scene, frames);
        const ParameterInfo& range = fractal.shape.at(schedule.number());
        double last = -1;
        for (const Knot& knot : schedule.knots()) {
            const double value = schedule.value(knot.frame);
            if (!(knot.frame > last && knot.frame < frames && value >= range.low && value <= range.high)) std::abort();
            last = knot.frame;
        }
    });
}
