// SPDX-License-Identifier: Apache-2.0
#include "core/text/number.h"

namespace mandelmarch {
bool is_whole(std::string_view text);
bool is_whole(std::string_view text) { return parse_whole(text).has_value(); }
}  // namespace mandelmarch
