// SPDX-License-Identifier: Apache-2.0
#include "flight/film/ffmpeg_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

namespace mandelmarch {
namespace {

constexpr const char* no_space = "No space left on device";

// Returns the line of ffmpeg's errors that names the cause: the message of a full disk, if it is among them, else the
// first line, as later ones are more general.
std::string cause_of(const std::string& errors)
{
    if (errors.find(no_space) != std::string::npos) return no_space;
    const std::size_t begin = std::min(errors.find_first_not_of('\n'), errors.size());
    return errors.substr(begin, errors.find('\n', begin) - begin);
}

}  // namespace

FfmpegProcess::FfmpegProcess(const std::vector<std::string>& command, const std::string& folder, double limit)
    : limit_(limit)
{
    auto [theirs, ours] = make_pipe();
    fcntl(ours.number(), F_SETFL, O_NONBLOCK);
    child_.emplace(ChildSetup{.words = command,
                              .folder = folder,
                              .input = theirs.number(),
                              .output = output_.number(),
                              .errors = errors_.number()});
    input_ = std::move(ours);
}

bool FfmpegProcess::write(const void* data, std::size_t size)
{
    const char* next = static_cast<const char*>(data);
    while (size > 0) {
        pollfd pipe{.fd = input_.number(), .events = POLLOUT, .revents = 0};
        const int ready = poll(&pipe, 1, static_cast<int>(std::ceil(std::min(1e3 * limit_, 1e9))));
        if (ready == 0) {
            hung_ = true;
            kill();
            return false;
        }
        const ssize_t written = ::write(input_.number(), next, size);
        if (written < 0 && errno != EINTR && errno != EAGAIN) return false;
        if (written <= 0) continue;
        next += written;
        size -= static_cast<std::size_t>(written);
    }
    return true;
}

FfmpegProcess::Result FfmpegProcess::finish()
{
    input_ = Descriptor();
    const Ended& ended = child_->end(limit_);
    Result result{.output = output_.text(), .cause = cause_of(errors_.text())};
    if (hung_ || ended.timed_out) {
        result.cause = fmt::format("no answer in {:.6g} s", limit_);
    } else if (ended.code == 0 && result.cause != no_space) {
        result.cause.clear();  // ffmpeg may return exit code 0 although it could not write the end of its file
    } else if (ended.signal != 0 || result.cause.empty()) {
        result.cause = ended.text();
    }
    return result;
}

}  // namespace mandelmarch
