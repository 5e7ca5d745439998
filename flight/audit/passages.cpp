// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/passages.h"

#include <algorithm>

namespace mandelmarch {
namespace {

constexpr double narrowing = 2;        // ratio of the clearances outside and inside a passage
constexpr double same_clearances = 2;  // clearances; passages closer to each other than this count as one
constexpr double same_size = 0.02;     // fractal sizes; the same limit again: the larger of the two applies

}  // namespace

std::vector<Passage> distinct_passages(const FieldOf& field, std::span<const Vector> places,
                                       std::span<const double> clearances)
{
    std::vector<Passage> passages;
    std::vector<Vector> known;
    // When the clearance has fallen to half of `widest` or less, `least` becomes the frame with the smallest clearance
    // from there on. That frame is a passage as soon as the clearance has grown to twice its clearance.
    double widest = 0;  // the largest clearance since the last passage
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
