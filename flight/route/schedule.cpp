// SPDX-License-Identifier: Apache-2.0
#include "flight/route/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "core/text/number.h"
#include "core/text/text.h"
#include "flight/field/field.h"
#include "flight/path/path.h"

namespace mandelmarch {
namespace {

constexpr std::size_t longest_value = 80;  // bytes of a value in a message
constexpr int looks = 256;                 // number of values that are checked between two keyframes

class Parser {
public:
    Parser(std::string_view name, const std::string& text, const Scene& scene, int frames)
        : name_(name), text_(text), scene_(scene), frames_(frames), number_(number_of(name))
    {
    }

    Schedule schedule() const
    {
        std::vector<Knot> knots;
        const double last = frames_ - 1;
        if (text_.find('=') != std::string::npos) {
            for (const std::string_view part : split(text_, ',')) knots.push_back(knot(part));
        } else if (const auto values = split(text_, ':'); values.size() == 2) {
            knots = {{0, value(values[0])}, {last, value(values[1])}};
        } else {
            knots = {{0, value(text_)}};
        }
        for (std::size_t k = 1; k < knots.size(); ++k) {
            if (!(knots[k].frame > knots[k - 1].frame)) {
                fail(fmt::format("{:.6g} s follows {:.6g} s, expected seconds that increase",
                                 knots[k].frame / frames_per_second, knots[k - 1].frame / frames_per_second));
            }
        }
        if (knots.back().frame > last) {
            // A keyframe at the end of the film, which is one frame after the last frame, is moved to the last frame.
            if (knots.back().frame > frames_) {
                fail(fmt::format("{:.6g} s is after the end of the film, expected at most {:.6g} s",
                                 knots.back().frame / frames_per_second,
                                 static_cast<double>(frames_) / frames_per_second));
            }
            knots.back().frame = last;
            if (knots.size() > 1 && knots[knots.size() - 2].frame >= last) fail("two values for the last frame");
        }
        check(knots);
        return {number_, std::move(knots)};
    }

private:
    [[noreturn]] void fail(const std::string& why) const
    {
        throw InputError(fmt::format("--{}: '{}': {}", name_, printable(text_, longest_value), why));
    }

    std::size_t number_of(std::string_view name) const
    {
        const auto& shape = scene_.fractal->shape;
        const auto found = std::ranges::find(shape, name, &ParameterInfo::name);
        if (found == shape.end()) {
            throw InputError(
                fmt::format("--{}: the {} has none, expected another fractal", name, scene_.fractal->name));
        }
        return static_cast<std::size_t>(found - shape.begin());
    }

    // Parses a value and rounds it to single precision, as the reader of parameter files rounds it.
    double value(std::string_view text) const
    {
        const ParameterInfo& meaning = scene_.fractal->shape[number_];
        const auto found = parse_real(text);
        const double value = found ? static_cast<float>(*found) : 0;
        const bool fine =
            found && value <= meaning.high && (meaning.open_low ? value > meaning.low : value >= meaning.low);
        if (!fine) {
            fail(fmt::format("'{}' is no {} {} {:.6g} and at most {:.6g}, expected A, A:B or 0s=A,60s=B, say",
                             printable(text, longest_value), meaning.name,
                             meaning.open_low ? "more than" : "of at least", meaning.low, meaning.high));
        }
        return value;
    }

    // Parses a keyframe such as "60s=5".
    Knot knot(std::string_view part) const
    {
        const auto equals = part.find('=');
        const std::string_view when = part.substr(0, equals);
        const auto seconds = when.ends_with('s') ? parse_real(when.substr(0, when.size() - 1)) : std::nullopt;
        if (equals == std::string_view::npos || !seconds || *seconds < 0) {
            fail(fmt::format("'{}' is not a time with a value, expected for example 60s=5",
                             printable(part, longest_value)));
        }
        return {*seconds * frames_per_second, value(part.substr(equals + 1))};
    }

    void check(const std::vector<Knot>& knots) const
    {
        for (std::size_t k = 0; k < knots.size(); ++k) {
            const double from = knots[k].value;
            const double to = knots[std::min(k + 1, knots.size() - 1)].value;
            for (int i = 0; i <= looks; ++i) {
                Scene there = scene_;
                there.shape[number_] = from + (to - from) * i / looks;
                const std::string_view objection = there.fractal->objection(there);
                if (!objection.empty()) fail(std::string(objection));
                if (const std::string why = flight_objection(there); !why.empty()) fail(why);
                if (from != to && !there.fractal->flight.body(there)) {
                    fail(fmt::format("at {:.4g} the size of the {} is unknown, expected other values",
                                     there.shape[number_], there.fractal->name));
                }
            }
        }
    }

    std::string_view name_;
    const std::string& text_;
    const Scene& scene_;
    int frames_;
    std::size_t number_;
};

}  // namespace

Schedule::Schedule(std::size_t number, std::vector<Knot> knots) : number_(number), knots_(std::move(knots)) {}

bool Schedule::changes() const
{
    return std::ranges::any_of(knots_, [this](const Knot& knot) { return knot.value != knots_.front().value; });
}

double Schedule::value(double frame) const
{
    const auto after = std::ranges::upper_bound(knots_, frame, {}, &Knot::frame);
    if (after == knots_.begin()) return knots_.front().value;
    if (after == knots_.end()) return knots_.back().value;
    const Knot& a = *(after - 1);
    const double u = (frame - a.frame) / (after->frame - a.frame);
    return a.value + (after->value - a.value) * u * u * (3 - 2 * u);
}

Schedule parse_schedule(std::string_view name, const std::string& text, const Scene& scene, int frames)
{
    return Parser(name, text, scene, frames).schedule();
}

}  // namespace mandelmarch
