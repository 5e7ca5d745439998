// SPDX-License-Identifier: Apache-2.0
// The audit of a path: what docs/flight.md promises, measured on every frame and between frames.
#pragma once

#include <string>
#include <vector>

#include "flight/path/path.h"

namespace mandelmarch {

// One row of the table.
struct Row {
    std::string name;
    double value = 0;
    double bar = 0;
    bool at_most = true;   // the value may be at most the bar; else at least
    bool promise = false;  // a path that misses it is not rendered without --force
    std::string unit;
    std::string worst;  // where it is worst, in words; may be empty

    bool kept() const { return at_most ? value <= bar : value >= bar; }
};

struct Audit {
    std::vector<Row> rows;

    bool promises_kept() const;
    int bars_missed() const;
};

// `threads`: 0 for one a core; the result does not depend on it. `planning`: seconds that planning took, a row if > 0.
// `stride`: the rows about views look at every N-th frame.
Audit audit(const Path& path, int threads, double planning = 0, int stride = 1);

// The promises alone, which need no views: seconds less.
Audit audit_promises(const Path& path, int threads);

std::string table_of(const Path& path, const Audit& audit);
std::string json_of(const Path& path, const Audit& audit);

}  // namespace mandelmarch
