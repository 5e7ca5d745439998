// SPDX-License-Identifier: Apache-2.0
// Schedules: the keyframes of a shape parameter that changes in flight.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch {

// A keyframe: a value of the shape parameter and the frame that has this value.
struct Knot {
    double frame;
    double value;
};

// A shape parameter as a function of time. It is constant before the first keyframe and after the last one. Between two
// keyframes it changes in proportion to u^2 (3 - 2 u), where u runs from 0 to 1; its derivative is continuous.
class Schedule {
public:
    // A schedule without changes.
    Schedule() = default;
    // `number`: index of the shape parameter in Scene::shape. The frames of `knots` must increase.
    Schedule(std::size_t number, std::vector<Knot> knots);

    std::size_t number() const { return number_; }
    const std::vector<Knot>& knots() const { return knots_; }
    bool changes() const;
    double value(double frame) const;

private:
    std::size_t number_ = 0;
    std::vector<Knot> knots_;
};

// Parses the schedule of the scene's shape parameter called `name`, for a film of `frames` frames. `text` has one of
// three forms: a constant value, "8"; the first and the last value, "8:5"; values at given seconds,
// "0s=8,60s=5,120s=8".
// Throws InputError with a message of one line in these cases:
// - The fractal does not have a parameter of this name.
// - The text does not have one of the forms.
// - The seconds do not increase, or are after the film's end.
// - With one of the values or a value in between, the fractal is invalid or cannot be flown through.
Schedule parse_schedule(std::string_view name, const std::string& text, const Scene& scene, int frames);

}  // namespace mandelmarch
