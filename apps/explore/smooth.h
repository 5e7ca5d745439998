// SPDX-License-Identifier: Apache-2.0
// A flight by hand into one that a film can be made of.
#pragma once

#include "flight/path/path.h"

namespace mandelmarch::explore {

// The camera between two frames; what changes is that of the nearer one.
Frame between(const Frame& a, const Frame& b, double share);

// The path with the hand's tremor taken out, where the walls leave room for it, and flown slower where a step or a turn
// is larger than the audit's promises allow. It has as many frames as that takes.
Path smoothed(const Path& path);

// The path with the camera of `frame` at frame number `at`, and those around it drawn along.
Path bent(Path path, std::size_t at, const Frame& frame);

}  // namespace mandelmarch::explore
