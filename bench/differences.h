// SPDX-License-Identifier: Apache-2.0
// What differs between the machines, builds and drivers that two results come from.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mandelmarch::bench {

// A line for each difference of two environments that may explain other times: revision, compilers, flags, CPU,
// system, drivers, variables.
std::vector<std::string> differences_of(const nlohmann::ordered_json& old_environment,
                                        const nlohmann::ordered_json& new_environment);

}  // namespace mandelmarch::bench
