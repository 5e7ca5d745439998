// SPDX-License-Identifier: Apache-2.0
// The choice between tours by their audits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "flight/audit/audit.h"
#include "flight/path/path.h"

namespace mandelmarch {

inline constexpr double broken_promise = 1000;  // the penalty of a broken promise, as a multiple of another item's

// Returns a penalty for missed thresholds and broken promises; 0 if there are none.
double faults(const Audit& audit);

// Returns true if the audit misses this item and no other.
bool misses_only(const Audit& audit, std::string_view item);

// Returns the items of the audit that miss their thresholds, with their values. `promises`: only promises count.
std::string missed_items(const Audit& audit, bool promises);

// The best flight of all tours so far.
struct Best {
    Path path;  // empty: no tour so far is long enough and passes all places
    double faults = 1e300;
    std::string promises;  // the broken ones

    // Replaces the flight by another one, if its audit is better.
    void take(Path other, const Audit& audit);
};

// Throws InputError with the message `missed_place`, if it is not empty and there is no flight. Throws Error if there
// is no flight for another reason, or if the best one breaks a promise. `gates`: their number, for the message.
void check_found(const Best& best, const std::string& missed_place, std::uint64_t seed, int frames, std::size_t gates);

}  // namespace mandelmarch
