// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/longest_stop.h"

namespace mandelmarch {

Stand longest_stand(std::span<const Vector> places, std::span<const double> radii)
{
    Stand longest;
    std::size_t outside = 0;  // index of the first place outside the last stand's radius
    for (std::size_t i = 0; i + longest.steps + 1 < places.size(); ++i) {
        const auto within = [&](std::size_t j) {
            ++longest.distances;
            return length(places[j] - places[i]) <= radii[i];
        };
        // A stand from i that is longer than the longest so far includes `far`. The place that ended the last stand
        // probably ends this one, too, and is therefore tested first.
        const std::size_t far = i + longest.steps + 1;
        if (!within(far) || (outside > i && outside < far && !within(outside))) continue;
        outside = i + 1;
        while (outside < places.size() && within(outside)) ++outside;
        if (outside - 1 - i > longest.steps) {
            longest.steps = outside - 1 - i;
            longest.first = i;
        }
    }
    return longest;
}

}  // namespace mandelmarch
