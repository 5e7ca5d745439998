// SPDX-License-Identifier: Apache-2.0
// Protocol of `bench duel`. A duel starts processes of bench, which call draw_on_demand() to render pictures at the
// duel's request.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "bench/study/options.h"
#include "core/base/descriptor.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

// Exchanges lines of text over a socket between two processes.
class LineSocket {
public:
    explicit LineSocket(Descriptor socket) : socket_(std::move(socket)) {}

    // Sends a line, given without its newline. Throws Error if the peer is gone.
    void send(const std::string& line);

    // Waits for a line. Returns false if the peer has closed the socket, or if gone() returns true and no complete line
    // is left; gone() is called repeatedly while nothing arrives. Throws Error for a line of more than 16 MiB.
    bool receive(
        std::string& line, const std::function<bool()>& gone = [] { return false; });

private:
    Descriptor socket_;
    std::string left_;  // bytes received after the last returned line
};

inline constexpr int on_demand_version = 1;  // version of the protocol below

// Prepares the configurations of the options, then serves requests over the socket on standard input until the peer
// closes it. `prove`: verify the configurations' pictures first, as a study does. The messages are lines of text:
//   first, to the peer: JSON, {"version", "environment", "rows": [{"name", "in_process", "fingerprint", "failure"}]}.
//     Configurations without a device on this machine are left out. in_process: false if a driver renders in another
//     process. failure: null, or the reason why the configuration cannot be timed.
//   request, from the peer: the name of a configuration
//   answer to each request: JSON, {"kernel": seconds, "processor": seconds} or {"failure": text}
void draw_on_demand(const Registry& registry, const Options& options, bool prove);

}  // namespace mandelmarch::bench
