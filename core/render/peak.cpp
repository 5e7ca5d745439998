#include "core/render/peak.h"

#include <algorithm>
#include <cmath>

namespace mandelmarch {
namespace {

constexpr double long_enough = 0.02;  // seconds of one run: clocks and launches are nothing beside it
constexpr int runs = 8;
constexpr int most_rounds = 1 << 28;

}  // namespace

double highest_rate(const PeakRun& run, double lanes)
{
    int rounds = 256;
    run(rounds);  // starts threads and finishes compiling
    double seconds = 0;
    for (;;) {
        seconds = run(rounds);
        if (seconds >= long_enough || rounds >= most_rounds) break;
        const double wanted = seconds > 0 ? 1.2 * rounds * long_enough / seconds : 8.0 * rounds;
        rounds = static_cast<int>(std::clamp(wanted, 2.0 * rounds, std::min(8.0 * rounds, double{most_rounds})));
    }
    for (int i = 0; i < runs; ++i) seconds = std::min(seconds, run(rounds));
    return seconds > 0 ? peak_operations_per_round * rounds * lanes / seconds : 0;
}

}  // namespace mandelmarch
