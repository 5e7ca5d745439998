// SPDX-License-Identifier: Apache-2.0
// A pair of connected sockets between two processes of one machine. Messages arrive whole, optionally with a file
// descriptor.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/base/descriptor.h"

namespace mandelmarch::isolation {

struct Packet {
    std::string bytes;
    Descriptor descriptor;  // received with the message, if any
};

class Channel {
public:
    static constexpr std::size_t largest = 1 << 16;  // max bytes of a message

    static std::pair<Channel, Channel> pair();  // throws Error
    explicit Channel(Descriptor socket) : socket_(std::move(socket)) {}

    // Returns false if the other side has closed. Throws Error if the message is larger than `largest`.
    bool send(const std::string& bytes, int descriptor = -1) const;
    // Waits for a message; nullopt if the other side has closed.
    std::optional<Packet> receive() const;
    // True if a message, or the end of the channel, can be received without waiting.
    bool waiting() const;

    int number() const { return socket_.number(); }

private:
    Descriptor socket_;
};

}  // namespace mandelmarch::isolation
