// SPDX-License-Identifier: Apache-2.0
// A child process that reads from a pipe: ffmpeg.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mandelmarch {

// Starts in the constructor; its output is kept.
class FfmpegProcess {
public:
    // `folder`: working directory; empty: the caller's. `limit`: seconds after which the child is killed if it does not
    // read or does not end; finish() reports that. Without a limit, the child may take for ever. Throws Error if it
    // cannot be started.
    FfmpegProcess(const std::vector<std::string>& command, const std::string& folder,
                 std::optional<double> limit = std::nullopt);
    ~FfmpegProcess();  // kills a child that still runs, and waits for it
    FfmpegProcess(const FfmpegProcess&) = delete;
    FfmpegProcess& operator=(const FfmpegProcess&) = delete;

    // Returns false if the child does not read any more; finish() reports the cause.
    bool write(const void* data, std::size_t size);
    // Kills the child. A write() in another thread then returns.
    void kill();

    struct Result {
        bool ok = false;
        std::string output;  // stdout
        std::string cause;   // in one line: an error from stderr, the signal or the exit code; empty if fine
    };
    // Closes the pipe and waits for the child's end.
    Result finish();

private:
    bool ready();
    int wait();

    std::optional<double> limit_;
    bool hung_ = false;
    int child_ = -1;
    int input_ = -1;
    int output_ = -1;
    int errors_ = -1;
};

}  // namespace mandelmarch
