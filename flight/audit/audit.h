// SPDX-License-Identifier: Apache-2.0
// The audit of a path. It measures each item of the table in docs/flight.md at all frames and between consecutive
// frames.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "flight/path/path.h"

namespace mandelmarch {

// An item of the audit: a measured value and its threshold `bar`.
struct Row {
    std::string name;
    double value = 0;
    double bar = 0;
    bool at_most = true;   // `bar` is an upper limit; false: a lower limit
    bool promise = false;  // true: a path that misses `bar` is rendered only with --force
    std::string unit = {};
    std::optional<std::size_t> frame = {};  // the frame with the worst value
    std::string note = {};                  // about the value, if no single frame is the worst; may be empty

    bool kept() const { return at_most ? value <= bar : value >= bar; }
    // Returns the frame, such as "frame 12", or the note.
    std::string worst() const;
};

inline constexpr double broken_promise = 1000;  // the penalty of a broken promise, as a multiple of another item's

struct Audit {
    std::vector<Row> rows;
    std::vector<std::size_t> repeated;  // frames whose view repeats an earlier one, which one of the items counts

    bool promises_kept() const;
    int bars_missed() const;
    // Returns a penalty for missed thresholds and broken promises; 0 if there are none.
    double faults() const;
    // Returns the items that miss their thresholds, with their values. `promises`: only promises count.
    std::string missed(bool promises) const;
};

// Measures all items. `threads`: 0 for as many as the process may use; the number does not change the result.
// `stride`: items about views use every stride-th frame only.
Audit audit(const Path& path, int threads, int stride = 1);

// Measures only the promises. This is faster than audit(), because no views are computed.
Audit audit_promises(const Path& path, int threads);

std::string table_of(const Path& path, const Audit& audit);
// `planning`: the planning time in seconds; 0: not known.
std::string json_of(const Path& path, const Audit& audit, double planning = 0);

}  // namespace mandelmarch
