// SPDX-License-Identifier: Apache-2.0
// A study whose pictures another process asks for, one by one: a side of `bench duel`.
#pragma once

#include "bench/options.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

inline constexpr int on_demand_version = 1;  // of the lines below

// Makes the rows of the options ready and obeys standard input, a socket. Each line is one JSON value:
//   first, to the other side: {"version", "environment", "rows": [{"name", "in_process", "fingerprint", "failure"}]};
//   rows
//     that this machine has no device for are left out, in_process says that no driver draws them elsewhere, a failure
//     is null or why there is no speed
//   from the other side: the name of a row
//   its answer: {"kernel": seconds, "processor": seconds} or {"failure": text}
// until the other side closes the socket. `prove`: compare the rows' pictures first, as a study does.
void draw_on_demand(const Registry& registry, const Options& options, bool prove);

}  // namespace mandelmarch::bench
