// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/start_views.h"

#include <vector>

namespace mandelmarch::explore {

std::span<const StartView> start_views()
{
    static const std::vector<StartView> embedded{
#include "start_views.inc"
    };
    return embedded;
}

}  // namespace mandelmarch::explore
