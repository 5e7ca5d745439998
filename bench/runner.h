// SPDX-License-Identifier: Apache-2.0
// The timed rounds: what is drawn when, and its times as the backends report them.
//
// A round draws every row that still needs samples, in an order that is shuffled anew for each round, so that a
// disturbance that lasts meets all rows alike and rows can be compared round by round. A row is done when the 95 %
// interval of its median is narrower than 2 % to either side, or at its limit of time or of rounds.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/study.h"
#include "core/image/image.h"

namespace mandelmarch::bench {

// A row that has passed its proof, ready to be timed.
struct Live {
    Case* one = nullptr;
    std::unique_ptr<Renderer> renderer;
    RenderReport first = {};        // of the picture that was proven
    std::uint64_t fingerprint = 0;  // of that picture: every timed one must be the same
    double expected = 0;            // seconds of a picture
    double spent = 0;               // seconds in the timed rounds
    bool done = false;
};

struct Rules {
    std::optional<int> repetitions;  // exactly so many rounds
    double budget = 75;              // seconds of all rounds
    double row_budget = 8;           // seconds of one row
    double long_picture = 4;         // seconds: a picture that takes longer is drawn once, for its proof
    int least = 6;                   // rounds: fewer give no 95 % interval of a median
    int most = 40;
    double half_width = 0.02;  // of the interval, relative to the median: narrow enough
    std::uint64_t seed = 1;
    int launch = 0;
};

// Rows whose picture takes longer than rules.long_picture are done: the picture that was proven is their sample.
void keep_long_pictures(std::vector<Live>& rows, const Rules& rules);

// Draws the rounds and puts the samples into the rows. A row that throws, or whose picture is no longer the proven one,
// fails and loses its samples. `progress` receives the finished share, 0 to 1, and the round, "round 3 of 40".
using RoundProgress = std::function<void(double share, const std::string& round)>;
void run_rounds(std::vector<Live>& rows, const Rules& rules, const RoundProgress& progress);

// Draws one sample: a picture, or setting.frames of them from a fresh renderer. Throws what the backend throws, and
// Error where the picture is not the proven one.
Sample draw_sample(Live& row, Image& image);

}  // namespace mandelmarch::bench
