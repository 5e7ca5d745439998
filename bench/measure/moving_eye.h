// SPDX-License-Identifier: Apache-2.0
// Rounds whose views differ, so that a program that replays a picture of an earlier run is noticed.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "bench/measure/runner.h"
#include "bench/measure/verify.h"

namespace mandelmarch::bench {

class MovingEye {
public:
    explicit MovingEye(const Registry& registry) : pictures_(registry) {}

    // Moves the eye of all scenes, in an unpredictable direction, for the next round.
    void next_round() { views_.clear(); }

    void group(std::vector<TimedCase*>& order) const
    {
        pictures_.group(order, [](const TimedCase* row) -> const Case& { return *row->one; });
    }

    // Returns the configuration with this round's view. Its picture differs visibly from that of the configuration's
    // own scene; if all nearby views look like it, adds a warning.
    const Case& view_of(const Case& one);

    // Returns what is wrong with the picture of view_of(one); empty if it is correct.
    std::string fault_of(const Case& one, const Image& image);

    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    // A configuration of each expected picture, its own picture, and how far its eye moves: the fraction of its
    // distance to the target.
    struct Group {
        Case of;
        Image own;
        double share;
    };
    std::size_t group_of(const Case& one);
    Case moved(const Case& one, double share);

    ExpectedPictures pictures_;
    std::vector<Group> groups_;
    std::map<std::size_t, Case> views_;               // of this round, by group
    std::mt19937_64 random_{std::random_device{}()};  // a program must not predict the views
    std::vector<std::string> warnings_;
};

}  // namespace mandelmarch::bench
