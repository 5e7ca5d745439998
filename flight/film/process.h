// SPDX-License-Identifier: Apache-2.0
// A child process that is fed through a pipe: ffmpeg.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mandelmarch {

// Starts in the constructor; what it prints is kept.
class Process {
public:
    // `folder`: where it runs; empty: here. `limit`: seconds that it may read nothing, or take to end; then it is
    // killed, and finish() says so. Without it may take for ever. Throws Error if it cannot be started.
    Process(const std::vector<std::string>& command, const std::string& folder,
            std::optional<double> limit = std::nullopt);
    ~Process();  // a child that still runs is killed and waited for
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    // False if the child reads no more; why is told by finish().
    bool write(const void* data, std::size_t size);
    // Kills it: a write() in another thread comes back.
    void kill();

    struct Result {
        bool fine = false;
        std::string output;  // its stdout
        std::string cause;   // in one line: what its stderr said, or which signal ended it; empty if fine
    };
    // Closes the pipe and waits for the end.
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
