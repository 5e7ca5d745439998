// SPDX-License-Identifier: Apache-2.0
// Differences between the machines, builds and drivers of two results.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mandelmarch::bench {

// Returns the value at a JSON pointer of an environment, or null if it is missing.
nlohmann::ordered_json value_at(const nlohmann::ordered_json& environment, const std::string& pointer);

// Returns true if two facts of a machine are equal. The order of keys and the order in a list do not count.
bool same_fact(const nlohmann::ordered_json& one, const nlohmann::ordered_json& other);

// Returns a line for each difference of two environments that may explain different times: "git/revision: a in the old
// result, b in the new".
std::vector<std::string> differences_of(const nlohmann::ordered_json& old_environment,
                                        const nlohmann::ordered_json& new_environment);

}  // namespace mandelmarch::bench
