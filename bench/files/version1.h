// SPDX-License-Identifier: Apache-2.0
// Converts files in version 1 of the format, which has other names for the same quantities.
#pragma once

#include <nlohmann/json.hpp>

namespace mandelmarch::bench {

// Changes a result, a duel or an equivalence test of version 1 to version 2. Does not add derived figures that version
// 1 lacks, because the reader computes them from the samples. JSON of another kind or version stays as it is.
void upgrade(nlohmann::ordered_json& json);

}  // namespace mandelmarch::bench
