// SPDX-License-Identifier: Apache-2.0
#include "core/render/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <regex>
#include <type_traits>

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch {
namespace {

// Returns the position of a floating-point number in the order of all such numbers. The positions of adjacent numbers
// differ by 1. 0 and -0 have the same position.
template <class Real>
double rank(Real value)
{
    using Bits = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;
    const auto bits = std::bit_cast<Bits>(value);
    return static_cast<double>(bits < 0 ? std::numeric_limits<Bits>::min() - bits : bits);
}

template <class Real>
double ulps_between(double a, double b)
{
    const Real x = static_cast<Real>(a);
    const Real y = static_cast<Real>(b);
    if (x == y) return 0;
    if (std::isnan(x) || std::isnan(y) || std::isinf(x) || std::isinf(y)) {
        return std::numeric_limits<double>::infinity();
    }
    return std::abs(rank(x) - rank(y));
}

template <class Real>
double largest_ulps(const Image& a, const Image& b)
{
    double largest = 0;
    for (std::size_t i = 0; i < a.values().size(); ++i) {
        const PixelValue& x = a.values()[i];
        const PixelValue& y = b.values()[i];
        largest = std::max({largest, ulps_between<Real>(x.red, y.red), ulps_between<Real>(x.green, y.green),
                            ulps_between<Real>(x.blue, y.blue), ulps_between<Real>(x.depth, y.depth)});
    }
    return largest;
}

bool has_nan(const Image& image)
{
    return std::ranges::any_of(image.values(), [](const PixelValue& v) {
        return std::isnan(v.red) || std::isnan(v.green) || std::isnan(v.blue) || std::isnan(v.depth);
    });
}

}  // namespace

std::string_view name_of(Level level)
{
    switch (level) {
        case Level::same_bits: return "same bits";
        case Level::ulps: return "ULP";
        case Level::perceptual: return "perceptual";
        default: return "different";
    }
}

Level level_required(Mode mode) { return mode == Mode::exact ? Level::same_bits : Level::perceptual; }

Agreement agreement(const Image& expected, const Image& image, Precision precision)
{
    Agreement result;
    result.comparison = compare(expected, image);
    result.largest_ulps =
        precision == Precision::f32 ? largest_ulps<float>(expected, image) : largest_ulps<double>(expected, image);
    const Comparison& c = result.comparison;
    const double visible_percent = 100.0 * static_cast<double>(c.visibly_differing) / static_cast<double>(c.pixels);
    result.numbers = c.values_compared && !has_nan(image);
    if (!result.numbers) {
        result.level = Level::different;
    } else if (c.same()) {
        result.level = Level::same_bits;
    } else if (result.largest_ulps <= most_ulps) {
        result.level = Level::ulps;
    } else if (visible_percent <= most_visible_percent) {
        result.level = Level::perceptual;
    }
    return result;
}

std::string render_command(const Scene& scene, const RendererOptions& options)
{
    const std::string lines = std::regex_replace(to_parameters(scene), std::regex("#.*\n"), "");
    return fmt::format("bin/render --fractal {} --precision {} --mode {} - <<< $'{}'", scene.fractal->short_name,
                       name_of(options.precision), name_of(options.mode),
                       std::regex_replace(lines, std::regex("\n"), "\\n"));
}

std::string summary(const Agreement& agreement)
{
    const Comparison& c = agreement.comparison;
    switch (agreement.level) {
        case Level::same_bits: return "same bits";
        case Level::ulps: return fmt::format("{:.0f} ULP", agreement.largest_ulps);
        default:
            return fmt::format("{:.3f} % off",
                               100.0 * static_cast<double>(c.visibly_differing) / static_cast<double>(c.pixels));
    }
}

}  // namespace mandelmarch
