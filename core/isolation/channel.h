// SPDX-License-Identifier: Apache-2.0
// A pair of connected sockets between two processes of one machine: messages, each whole, with a descriptor where one
// is given.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/isolation/descriptor.h"

namespace mandelmarch::isolation {

struct Packet {
    std::string bytes;
    Descriptor descriptor;  // that came with it, if any
};

class Channel {
public:
    static constexpr std::size_t largest = 1 << 16;  // bytes of a message

    static std::pair<Channel, Channel> pair();  // throws Error
    explicit Channel(Descriptor socket) : socket_(std::move(socket)) {}

    // False where the other side has gone. Throws Error where the message is larger than `largest`.
    bool send(const std::string& bytes, int descriptor = -1) const;
    // Waits for a message; nullopt where the other side has gone.
    std::optional<Packet> receive() const;
    // True where a message, or the other side's end, can be received at once.
    bool waiting() const;

    int number() const { return socket_.number(); }

private:
    Descriptor socket_;
};

}  // namespace mandelmarch::isolation
