// SPDX-License-Identifier: Apache-2.0
#include "core/isolation/channel.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "core/text/error.h"

namespace mandelmarch::isolation {

std::pair<Channel, Channel> Channel::pair()
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        throw Error(fmt::format("no sockets for a device's process: {}", std::strerror(errno)));
    }
    return {Channel(Descriptor(ends[0])), Channel(Descriptor(ends[1]))};
}

bool Channel::send(const std::string& bytes, int descriptor) const
{
    if (bytes.size() > largest) throw Error("a message for a device's process is too large");
    iovec part{const_cast<char*>(bytes.data()), bytes.size()};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    if (descriptor >= 0) {
        message.msg_control = control;
        message.msg_controllen = sizeof control;
        cmsghdr* header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(header), &descriptor, sizeof(int));
    }
    for (;;) {
        if (sendmsg(number(), &message, MSG_NOSIGNAL) >= 0) return true;
        if (errno != EINTR) return false;
    }
}

bool Channel::waiting(int milliseconds) const
{
    pollfd from{number(), POLLIN, 0};
    int ready = 0;
    do {
        ready = poll(&from, 1, milliseconds);
    } while (ready < 0 && errno == EINTR);
    return ready > 0;
}

std::optional<Packet> Channel::receive() const
{
    Packet packet{std::string(largest, '\0'), {}};
    iovec part{packet.bytes.data(), packet.bytes.size()};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    ssize_t size = 0;
    do {
        size = recvmsg(number(), &message, MSG_CMSG_CLOEXEC);
    } while (size < 0 && errno == EINTR);
    if (size <= 0) return std::nullopt;
    packet.bytes.resize(static_cast<std::size_t>(size));
    if ((message.msg_flags & MSG_CTRUNC) != 0) throw Error("a device's process: " + std::string(std::strerror(EMFILE)));
    if (const cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr && header->cmsg_type == SCM_RIGHTS) {
        int descriptor = -1;
        std::memcpy(&descriptor, CMSG_DATA(header), sizeof(int));
        packet.descriptor = Descriptor(descriptor);
    }
    return packet;
}

}  // namespace mandelmarch::isolation
