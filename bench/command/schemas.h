// SPDX-License-Identifier: Apache-2.0
// The published JSON Schemas of the files that bench writes, generated from the descriptions of their records.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mandelmarch::bench {

// Returns the kinds of files: "result", "duel", ...
std::vector<std::string> schema_kinds();

// Returns the schema of a kind of file; bench/schemas has copies. Throws InputError, which lists the kinds, if `kind`
// is none of them.
std::string schema_text(std::string_view kind);

}  // namespace mandelmarch::bench
