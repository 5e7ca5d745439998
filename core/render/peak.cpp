// SPDX-License-Identifier: Apache-2.0
#include "core/render/peak.h"

#include <algorithm>

namespace mandelmarch {
namespace {

constexpr double long_enough = 0.02;  // min seconds of a run; clock resolution and launch overhead are then negligible
constexpr int runs = 9;
constexpr int most_rounds = 1 << 28;

}  // namespace

double highest_rate(const PeakRun& run, double lanes)
{
    int rounds = 256;
    run(rounds);  // starts threads and completes compilation
    for (;;) {
        // Disturbances only make a run longer. So the number of iterations is sufficient when even the fastest run is
        // long enough.
        double fastest = run(rounds);
        for (int i = 1; i < runs && (fastest >= long_enough || rounds == most_rounds); ++i) {
            fastest = std::min(fastest, run(rounds));
        }
        if (rounds == most_rounds || fastest >= long_enough) {
            return fastest > 0 ? peak_operations_per_round * rounds * lanes / fastest : 0;
        }
        const double wanted = fastest > 0 ? 1.2 * rounds * long_enough / fastest : 8.0 * rounds;
        rounds = static_cast<int>(std::min(std::clamp(wanted, 2.0 * rounds, 8.0 * rounds), double{most_rounds}));
    }
}

}  // namespace mandelmarch
