// SPDX-License-Identifier: Apache-2.0
// Keyframes of one shape parameter of a fractal that changes in flight.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch {

// A keyframe: a value of the shape parameter, and the frame at which it is reached.
struct Knot {
    double frame;
    double value;
};

// A shape parameter as a function of time. It is constant before the first keyframe and after the last; between two it
// is interpolated by u^2 (3 - 2 u), whose derivative is continuous.
class Schedule {
public:
    // A schedule without changes.
    Schedule() = default;
    // `number`: index of the shape parameter in Scene::shape. Frames must increase from keyframe to keyframe.
    Schedule(std::size_t number, std::vector<Knot> knots);

    std::size_t number() const { return number_; }
    const std::vector<Knot>& knots() const { return knots_; }
    bool changes() const;
    double value(double frame) const;

private:
    std::size_t number_ = 0;
    std::vector<Knot> knots_;
};

// Parses the schedule of the scene's shape parameter called `name`, for a film of `frames` frames. `text` is one value,
// "8"; the first and the last, "8:5"; or values at given seconds, "0s=8,60s=5,120s=8". Throws InputError, in one line,
// if the fractal has no such parameter, the text has another form, seconds do not increase or are after the film's end,
// or the fractal cannot be flown through at some value in between.
Schedule parse_schedule(std::string_view name, const std::string& text, const Scene& scene, int frames);

}  // namespace mandelmarch
