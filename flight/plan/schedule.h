// SPDX-License-Identifier: Apache-2.0
// How one number of a fractal's shape changes in a flight.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch {

// A value and the frame at which the number has it.
struct Knot {
    double frame;
    double value;
};

// Before the first knot and behind the last the number stays. Between two it goes from one value to the other, slowly
// at first and at last: by u^2 (3 - 2 u), whose rate has no jump.
class Schedule {
public:
    // Nothing changes.
    Schedule() = default;
    // `number`: which of the scene's three shape numbers. Frames grow from knot to knot.
    Schedule(std::size_t number, std::vector<Knot> knots);

    std::size_t number() const { return number_; }
    const std::vector<Knot>& knots() const { return knots_; }
    bool changes() const;
    double value(double frame) const;

private:
    std::size_t number_ = 0;
    std::vector<Knot> knots_;
};

// The schedule of `text` for the shape number that the scene's fractal calls `name`, in a film of so many frames: one
// value, "8"; the first and the last, "8:5"; or values at named seconds, "0s=8,60s=5,120s=8". Throws InputError, in one
// line, where the fractal has no such number, the text is none of these, seconds do not grow or lie behind the film's
// end, or the fractal cannot be flown through at some value on the way.
Schedule parse_schedule(std::string_view name, const std::string& text, const Scene& scene, int frames);

}  // namespace mandelmarch
