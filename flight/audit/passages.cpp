// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/passages.h"

#include <algorithm>

namespace mandelmarch {
namespace {

constexpr double narrowing = 2;        // factor
constexpr double same_clearances = 2;  // passages closer to each other than this count as one, clearances
constexpr double same_size = 0.02;     // the same in fractal sizes; the larger one applies

}  // namespace

std::vector<Passage> distinct_passages(const FieldOf& field, std::span<const Vector> places,
                                       std::span<const double> clearances)
{
    std::vector<Passage> passages;
    std::vector<Vector> known;
    // The narrowest point since the last wide place becomes a passage once the clearance has doubled.
    double widest = 0;  // since the last passage
    bool narrowed = false;
    Passage least{0, 0};
    for (std::size_t i = 0; i < clearances.size(); ++i) {
        const double here = clearances[i];
        if (!narrowed) {
            widest = std::max(widest, here);
            if (narrowing * here > widest) continue;
            narrowed = true;
            least = {i, here};
            continue;
        }
        if (here < least.clearance) least = {i, here};
        if (here < narrowing * least.clearance) continue;
        narrowed = false;
        widest = here;
        const DistanceField& there = field(least.frame);
        if (!there.bounds().contains(places[least.frame])) continue;
        const Vector place = there.representative(places[least.frame]);
        const double apart = std::max(same_clearances * least.clearance, same_size * there.bounds().size);
        if (std::ranges::any_of(known, [&](Vector k) { return length(k - place) < apart; })) continue;
        known.push_back(place);
        passages.push_back(least);
    }
    return passages;
}

}  // namespace mandelmarch
