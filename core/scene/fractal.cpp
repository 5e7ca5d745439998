// SPDX-License-Identifier: Apache-2.0
#include "core/scene/fractal.h"
#include "core/text/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "core/scene/descriptor.h"
#include "core/scene/scene.h"
#include "core/text/error.h"

namespace mandelmarch {

std::string_view defaults::objection(const Scene&) { return {}; }
double defaults::no_hull(const Scene&, const ViewLimits&) { return 0; }
std::optional<Bounds> defaults::unknown_body(const Scene&) { return {}; }
template <class Number>
Number defaults::step_factor(const FractalInputs<Number>&)
{
    return plain_step_factor;
}
template double defaults::step_factor(const FractalInputs<double>&);
template Formula defaults::step_factor(const FractalInputs<Formula>&);
double defaults::growth(const Scene&) { return 1; }
Vector defaults::representative(const Scene&, Vector p) { return p; }
bool defaults::worth_searching(const Scene&, const Bounds&, Vector) { return true; }
Vector defaults::upward(Vector place, Vector up) { return length(place) > 0 ? unit(place) : up; }
void defaults::no_tail(const Scene&, FractalConstants<double>&) {}
void defaults::same_shape(Scene&, SceneRandom&, bool) {}
void defaults::same_extreme_shape(Scene&, SceneRandom&) {}

const FractalFlight::Trust& FractalFlight::trust_of(const Scene& scene) const
{
    return scene.conservative && conservative ? *conservative : trust;
}

FractalInputs<double> inputs_of(const Scene& scene, double largest)
{
    return {.shape = scene.shape,
            .escape = scene.escape,
            .iterations = static_cast<double>(scene.iterations),
            .largest = largest,
            .conservative = scene.conservative ? 1.0 : 0.0};
}

std::span<const Fractal> fractals()
{
    static const auto table = [] {
        std::array all{
#define MM_FRACTAL(name) descriptors::name,
#include "fractals.inc"
#undef MM_FRACTAL
        };
        std::ranges::sort(all, {}, [](const Fractal& f) { return std::tuple(f.list_order, f.name); });
        return all;
    }();
    return table;
}

namespace {

// Makes the table before main(), so that its addresses are the same in the program and in its device processes, to
// which descriptors are passed by address (core/isolation).
[[maybe_unused]] const bool made = !fractals().empty();

}  // namespace

const Fractal& fractal_named(std::string_view name)
{
    for (const Fractal& fractal : fractals()) {
        if (fractal.name == name || fractal.short_name == name) return fractal;
    }
    const auto known = mapped(fractals(), &Fractal::name);
    throw InputError(fmt::format("no fractal is called '{}', expected one of {}", name, fmt::join(known, ", ")));
}

}  // namespace mandelmarch
