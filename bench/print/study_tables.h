// SPDX-License-Identifier: Apache-2.0
// Console tables of single studies.
#pragma once

#include <string>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Returns the tables of the studies profile and box-vs-bulb; empty for other studies.
std::string study_tables(const Result& result);

}  // namespace mandelmarch::bench
