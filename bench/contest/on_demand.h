// SPDX-License-Identifier: Apache-2.0
// Renders the pictures of a study at another process's request: one side of `bench duel`.
#pragma once

#include "bench/study/options.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

inline constexpr int on_demand_version = 1;  // of the protocol below

// Prepares the configurations of the options and serves requests on standard input, a socket, until the peer closes it.
// `prove`: verify the configurations' pictures first, as a study does. The messages are lines of text:
//   first, to the peer: JSON, {"version", "environment", "rows": [{"name", "in_process", "fingerprint", "failure"}]}.
//     Configurations without a device on this machine are left out. in_process: false if a driver renders in another
//     process. failure: null, or why there is no speed.
//   request, from the peer: the name of a configuration
//   answer to each request: JSON, {"kernel": seconds, "processor": seconds} or {"failure": text}
void draw_on_demand(const Registry& registry, const Options& options, bool prove);

}  // namespace mandelmarch::bench
