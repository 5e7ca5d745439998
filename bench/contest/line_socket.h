// SPDX-License-Identifier: Apache-2.0
// Exchanges lines of text over a socket between two processes.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/descriptor.h"

namespace mandelmarch::bench {

class LineSocket {
public:
    explicit LineSocket(Descriptor socket) : socket_(std::move(socket)) {}

    // Sends a line, given without its newline. Throws Error if the peer is gone.
    void send(const std::string& line);

    // Waits for a line. Returns false if the peer has closed the socket, or once gone(), which is polled, returns true.
    // Throws Error for a line of more than 16 MiB.
    bool receive(
        std::string& line, const std::function<bool()>& gone = [] { return false; });

private:
    Descriptor socket_;
    std::string left_;  // received part of later lines
};

// Returns JSON on one line. Invalid UTF-8 is replaced.
std::string text_of_line(const nlohmann::ordered_json& json);

}  // namespace mandelmarch::bench
