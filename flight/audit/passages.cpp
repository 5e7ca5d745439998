// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/passages.h"

#include <algorithm>

namespace mandelmarch {
namespace {

constexpr double narrowing = 2;        // times
constexpr double same_clearances = 2;  // passages nearer to each other than this many of their clearances are one
constexpr double same_size = 0.02;     // or than this share of the hull's size

}  // namespace

std::vector<Passage> distinct_passages(const FieldOf& field, std::span<const Vector> places,
                                       std::span<const double> clearances)
{
    std::vector<Passage> passages;
    std::vector<Vector> known;
    // One pass: a narrowest point since the last wide place counts once the path has widened to twice its clearance.
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
        const Field& there = field(least.frame);
        if (!there.hull().contains(places[least.frame])) continue;
        const Vector place = there.representative(places[least.frame]);
        const double apart = std::max(same_clearances * least.clearance, same_size * there.hull().size);
        if (std::ranges::any_of(known, [&](Vector k) { return length(k - place) < apart; })) continue;
        known.push_back(place);
        passages.push_back(least);
    }
    return passages;
}

}  // namespace mandelmarch
