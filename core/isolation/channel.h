// SPDX-License-Identifier: Apache-2.0
// A pair of connected sockets, for two processes on the same machine. A message arrives as a whole, and can carry a
// file descriptor.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/os/descriptor.h"

namespace mandelmarch::isolation {

struct Packet {
    std::string bytes;
    Descriptor descriptor;  // received with the message; empty if it had none
};

class Channel {
public:
    static constexpr std::size_t largest = 1 << 16;  // max bytes of a message

    static std::pair<Channel, Channel> pair();  // throws Error
    explicit Channel(Descriptor socket) : socket_(std::move(socket)) {}

    // Sends a message, with the descriptor unless it is -1. Returns false if the other side has closed. Throws Error if
    // the message is larger than `largest`.
    bool send(const std::string& bytes, int descriptor = -1) const;
    // Waits for a message and returns it; returns nullopt if the other side has closed. Throws Error if the process has
    // too many open files for the message's descriptor.
    std::optional<Packet> receive() const;
    // Waits at most this time until receive() would not wait, because a message is available or the other side has
    // closed. Returns false if it still would.
    bool waiting(int milliseconds = 0) const;

    int number() const { return socket_.number(); }

private:
    Descriptor socket_;
};

}  // namespace mandelmarch::isolation
