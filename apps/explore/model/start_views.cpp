// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/start_views.h"

#include <initializer_list>

namespace mandelmarch::explore {
namespace {

constexpr std::initializer_list<StartView> embedded{
#include "start_views.inc"
};

}  // namespace

std::span<const StartView> start_views() { return {embedded.begin(), embedded.size()}; }

}  // namespace mandelmarch::explore
