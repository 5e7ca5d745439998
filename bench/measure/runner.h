// SPDX-License-Identifier: Apache-2.0
// Timed rounds.
//
// A round renders every configuration that still needs samples, in a new random order each time, so that a lasting
// disturbance slows all alike and configurations can be compared round by round. A configuration is done when the 95 %
// interval of its median extends less than 2 % to either side, or when its limit of time or of rounds is reached.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/measure/cases.h"
#include "core/image/image.h"

namespace mandelmarch::bench {

// The current phase, its completed fraction, 0 to 1, and the position within it, "round 3 of 40".
struct Step {
    std::string what;
    double share = 0;
    std::string detail{};
};
using Phase = std::function<void(const Step&)>;

// A verified configuration, ready to be timed.
struct TimedCase {
    Case* one = nullptr;
    std::unique_ptr<Renderer> renderer;
    RenderStats first = {};         // stats of the verified picture
    std::uint64_t fingerprint = 0;  // of the verified picture; every timed picture must have the same fingerprint
    double expected = 0;            // expected kernel time of a picture, seconds
    double spent = 0;               // seconds so far in the timed rounds
    bool done = false;
};

// If a configuration's picture takes long, marks the configuration as done and takes the verified picture as its only
// sample. Does nothing if options.repetitions is given.
void keep_long_pictures(std::vector<TimedCase>& rows, const Options& options);

class MovingEye;

// Renders the rounds and adds the samples to the configurations. If a backend throws, or a picture differs from the
// verified one, its configuration fails and loses its samples. `options`: budget and repetitions are not both unset.
// `eye`: if not null, each round has other views.
void run_rounds(std::vector<TimedCase>& rows, const Options& options, const Phase& phase, MovingEye* eye = nullptr);

}  // namespace mandelmarch::bench
