// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "core/text/error.h"
#include "flight/audit/audit.h"

namespace mandelmarch {

// Returns the audit's item whose name starts with `name`.
inline const Row& row_of(const Audit& audit, const std::string& name)
{
    const auto row = std::ranges::find_if(audit.rows, [&](const Row& r) { return r.name.starts_with(name); });
    if (row == audit.rows.end()) throw Error("no row " + name);
    return *row;
}

}  // namespace mandelmarch
