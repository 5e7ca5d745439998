// SPDX-License-Identifier: Apache-2.0
#include "core/scene/fractal.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "core/base/error.h"
#include "core/scene/fractals/row.h"
#include "core/scene/scene.h"

namespace mandelmarch {

std::string_view usual::objection(const Scene&) { return {}; }
double usual::no_hull(const Scene&, const Sight&) { return 0; }
std::optional<Hull> usual::unknown_body(const Scene&) { return {}; }
template <class Number>
Number usual::stride(const FractalInputs<Number>&)
{
    return plain_stride;
}
template double usual::stride(const FractalInputs<double>&);
template Formula usual::stride(const FractalInputs<Formula>&);
double usual::growth(const Scene&) { return 1; }
Vector usual::representative(const Scene&, Vector p) { return p; }
bool usual::worth_searching(const Scene&, const Hull&, Vector) { return true; }
Vector usual::upward(Vector place, Vector up) { return length(place) > 0 ? unit(place) : up; }
void usual::no_tail(const Scene&, FractalConstants<double>&) {}
void usual::same_shape(Scene&, Chance&, bool) {}
void usual::same_extreme_shape(Scene&, Chance&) {}

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
#define MM_FRACTAL(name) rows::name,
#include "fractals.inc"
#undef MM_FRACTAL
        };
        std::ranges::sort(all, {}, [](const Fractal& row) { return std::tuple(row.rank, row.name); });
        return all;
    }();
    return table;
}

namespace {

// The table exists before main, because descriptors are passed to device processes (core/isolation) by address.
[[maybe_unused]] const bool made = !fractals().empty();

}  // namespace

const Fractal& fractal_named(std::string_view name)
{
    std::string known;
    for (const Fractal& fractal : fractals()) {
        if (fractal.name == name || fractal.nickname == name) return fractal;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", fractal.name);
    }
    throw InputError(fmt::format("no fractal is called '{}', expected one of {}", name, known));
}

}  // namespace mandelmarch
