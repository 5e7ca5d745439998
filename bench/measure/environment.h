// SPDX-License-Identifier: Apache-2.0
// Environment of a result: program, machine, drivers, date.
#pragma once

#include <nlohmann/json.hpp>

#include "core/render/registry.h"

namespace mandelmarch::bench {

// Returns the environment as read from /proc, /sys and the drivers. Values that cannot be read are null.
nlohmann::ordered_json environment(const Registry& registry);

}  // namespace mandelmarch::bench
