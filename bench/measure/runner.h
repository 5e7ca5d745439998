// SPDX-License-Identifier: Apache-2.0
// Timed rounds.
//
// A round renders every configuration that still needs samples, in a new random order each time, so that a lasting
// disturbance slows all alike and configurations can be compared round by round. A configuration is done when the 95 %
// interval of its median extends less than 2 % to either side, or when its limit of time or of rounds is reached.
#pragma once

#include <functional>
#include <memory>
#include <optional>
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

struct Rules {
    std::optional<int> repetitions;  // exact number of rounds
    double budget = 75;              // seconds for the rounds of all configurations
    double row_budget = 8;           // seconds for the rounds of one configuration
    double long_picture = 4;         // seconds: a picture that takes longer is rendered only once, for verification
    int least = 6;                   // rounds; fewer give no 95 % interval of a median
    int most = 40;
    double half_width = 0.02;  // of a 95 % interval, relative to the median; below it, a configuration is done
    std::uint64_t seed = 1;
    int run = 0;
};

// Returns the rules that follow from the options and their study.
Rules rules_of(const Options& options);

// If a configuration's picture takes longer than rules.long_picture, marks the configuration as done and takes the
// verified picture as its only sample. Does nothing if rules.repetitions is given.
void keep_long_pictures(std::vector<TimedCase>& rows, const Rules& rules);

class MovingEye;

// Renders the rounds and adds the samples to the configurations. If a backend throws, or a picture differs from the
// verified one, its configuration fails and loses its samples. `eye`: if not null, each round has other views.
void run_rounds(std::vector<TimedCase>& rows, const Rules& rules, const Phase& phase, MovingEye* eye = nullptr);

}  // namespace mandelmarch::bench
