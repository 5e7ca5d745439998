// SPDX-License-Identifier: Apache-2.0
#include "bench/harness/peaks.h"

#include <fmt/format.h>

#include <algorithm>

namespace mandelmarch::bench {
namespace {

constexpr double near_enough = 0.05;

bool same_device(const Peak& a, const Peak& b)
{
    return a.platform == b.platform && a.backend == b.backend && a.device == b.device && a.precision == b.precision;
}

// Returns the two highest rates; the second is 0 if there is only one.
std::pair<double, double> highest(const std::vector<Peak>& peaks)
{
    std::pair<double, double> found{0, 0};
    for (const Peak& peak : peaks) {
        if (peak.rate > found.first) {
            found = {peak.rate, found.first};
        } else {
            found.second = std::max(found.second, peak.rate);
        }
    }
    return found;
}

bool is_doubtful(const std::vector<Peak>& peaks)
{
    const auto [first, second] = highest(peaks);
    return second < (1 - near_enough) * first;
}

}  // namespace

void PeakRecord::add(const std::vector<Peak>& peaks)
{
    for (const Peak& peak : peaks) {
        const auto same = std::ranges::find_if(
            measured_, [&](const std::vector<Peak>& known) { return same_device(known.front(), peak); });
        if (same == measured_.end()) {
            measured_.push_back({peak});
        } else {
            same->push_back(peak);
        }
    }
}

std::vector<Peak> PeakRecord::best() const
{
    std::vector<Peak> found;
    for (const std::vector<Peak>& peaks : measured_) found.push_back(*std::ranges::max_element(peaks, {}, &Peak::rate));
    return found;
}

std::vector<Peak> PeakRecord::doubtful() const
{
    std::vector<Peak> found;
    for (const std::vector<Peak>& peaks : measured_) {
        if (is_doubtful(peaks)) found.push_back(peaks.front());
    }
    return found;
}

std::vector<std::string> PeakRecord::warnings() const
{
    std::vector<std::string> found;
    for (const std::vector<Peak>& peaks : measured_) {
        if (!is_doubtful(peaks)) continue;
        const auto [first, second] = highest(peaks);
        found.push_back(fmt::format("peak: {} {}, {}: {:.1f} GFLOP/s is the best of {}, the next is {:.1f}",
                                    peaks.front().backend, peaks.front().device, name_of(peaks.front().precision),
                                    1e-9 * first, peaks.size(), 1e-9 * second));
    }
    return found;
}

}  // namespace mandelmarch::bench
