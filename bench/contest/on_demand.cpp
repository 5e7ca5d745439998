// SPDX-License-Identifier: Apache-2.0
#include "bench/contest/on_demand.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "bench/machine/environment.h"
#include "bench/harness/verify.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int socket_patience = 200;  // milliseconds between two calls of gone()
constexpr std::size_t longest_line = std::size_t{16} << 20;

// Returns JSON on one line. Invalid UTF-8 is replaced.
std::string text_of_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json row_of(const Case& one, std::uint64_t fingerprint)
{
    const Row& row = one.row;
    return {{"name", row.name()},
            {"in_process", !one.backend->info().has_driver},
            {"fingerprint", fmt::format("{:016x}", fingerprint)},
            {"failure", row.failure.empty() ? Json() : Json(row.failure)}};
}

Json answer(std::vector<TimedCase>& rows, Image& image, const std::string& name)
{
    const auto found = std::ranges::find(rows, name, [](const TimedCase& live) { return live.one->row.name(); });
    if (found == rows.end()) return {{"failure", "no such row"}};
    const Scene& scene = found->one->scene;
    if (image.width() != scene.width || image.height() != scene.height) {
        image = Image(scene.width, scene.height, Image::Layers::bytes);
    }
    try {
        const Sample sample = draw_sample(*found, image);
        return {{"kernel", sample.kernel}, {"processor", sample.processor}};
    } catch (const std::exception& error) {
        return {{"failure", error.what()}};
    }
}

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
        if (left_.size() > longest_line) throw Error("the other side sends a line without an end");
        pollfd waiting{.fd = socket_.number(), .events = POLLIN, .revents = 0};
        const int ready = poll(&waiting, 1, socket_patience);
        if (ready == 0) {
            // If the peer has ended, read what it sent before it ended.
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

void draw_on_demand(const Registry& registry, const Options& options, bool prove)
{
    std::vector<Case> cases = cases_of(registry, options);
    ExpectedPictures pictures(registry);
    std::vector<Case*> order = pictures.grouped(cases);
    std::vector<TimedCase> ready;
    Json rows = Json::array();
    for (Case* one : order) {
        auto live = prove ? verified_case(*one, pictures) : unverified_case(*one);
        if (!one->row.unavailable.empty()) continue;
        rows.push_back(row_of(*one, live ? live->fingerprint : 0));
        if (live) ready.push_back(std::move(*live));
    }
    LineSocket socket(Descriptor(dup(STDIN_FILENO)));
    socket.send(text_of_line({{"version", on_demand_version}, {"environment", environment(registry)}, {"rows", rows}}));
    Image image;
    for (std::string name; socket.receive(name);) socket.send(text_of_line(answer(ready, image, name)));
}

}  // namespace mandelmarch::bench
