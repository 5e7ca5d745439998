// SPDX-License-Identifier: Apache-2.0
// Where a result comes from: the program, the machine, the drivers, the date.
#pragma once

#include <nlohmann/json.hpp>

#include "core/render/registry.h"

namespace mandelmarch::bench {

// Reads /proc, /sys and the drivers. What cannot be read is null.
nlohmann::ordered_json environment(const Registry& registry);

}  // namespace mandelmarch::bench
