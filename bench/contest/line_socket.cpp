// SPDX-License-Identifier: Apache-2.0
#include "bench/contest/line_socket.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

constexpr int patience = 200;  // milliseconds between checks whether the peer is gone
constexpr std::size_t longest = std::size_t{16} << 20;

}  // namespace

void LineSocket::send(const std::string& line)
{
    const std::string whole = line + "\n";
    for (std::size_t sent = 0; sent < whole.size();) {
        const ssize_t now = ::send(socket_.number(), whole.data() + sent, whole.size() - sent, MSG_NOSIGNAL);
        if (now < 0 && errno == EINTR) continue;
        if (now < 0) throw Error(fmt::format("the other side does not listen: {}", std::strerror(errno)));
        sent += static_cast<std::size_t>(now);
    }
}

bool LineSocket::receive(std::string& line, const std::function<bool()>& gone)
{
    for (bool last = false;;) {
        if (const auto end = left_.find('\n'); end != std::string::npos) {
            line = left_.substr(0, end);
            left_.erase(0, end + 1);
            return true;
        }
        if (last) return false;
        if (left_.size() > longest) throw Error("the other side sends a line without an end");
        pollfd waiting{.fd = socket_.number(), .events = POLLIN, .revents = 0};
        const int ready = poll(&waiting, 1, patience);
        if (ready == 0) {
            // If the peer has ended, read what it sent before.
            if (!gone()) continue;
            waiting.revents = 0;
            last = poll(&waiting, 1, 0) <= 0;
            if (last) continue;
        }
        if (ready < 0 && errno == EINTR) continue;
        char block[1 << 14];
        const ssize_t got = recv(socket_.number(), block, sizeof(block), 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        left_.append(block, static_cast<std::size_t>(got));
    }
}

std::string text_of_line(const nlohmann::ordered_json& json)
{
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace mandelmarch::bench
