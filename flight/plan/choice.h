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

// Returns a penalty for missed thresholds; 0 if none is missed.
double faults(const Audit& audit);

// Returns true if the audit misses this item and no other.
bool misses_only(const Audit& audit, std::string_view item);

// Returns the items of the audit that miss their thresholds, with their values. `promises`: only promises count.
std::string missed_items(const Audit& audit, bool promises);

// The best flight of all tours so far.
struct Best {
    Path path;  // empty: no tour is long enough and passes all places
    double faults = 1e300;
    std::string promises;  // the broken ones

    // Replaces the flight by another one, if its audit is better.
    void take(Path other, const Audit& audit);
};

// Throws Error if no tour gave a flight that keeps all promises, and InputError if tours missed a place.
void check_found(const Best& best, const std::string& missed_place, std::uint64_t seed, int frames, std::size_t gates);

}  // namespace mandelmarch
