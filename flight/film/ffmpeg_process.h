// SPDX-License-Identifier: Apache-2.0
// A child process that reads its input from a pipe. It is used for ffmpeg.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/child_process.h"

namespace mandelmarch {

// Starts in the constructor; its output is kept.
class FfmpegProcess {
public:
    // `folder`: working directory; empty: the caller's. `limit`: seconds after which the child is killed if it does not
    // read or does not end; finish() reports that. Throws Error if it cannot be started.
    FfmpegProcess(const std::vector<std::string>& command, const std::string& folder,
                  double limit = ChildProcess::no_limit);

    // Passes the data to the child. Returns false if the child has stopped reading; finish() then reports the cause.
    bool write(const void* data, std::size_t size);
    // Kills the child. A write() in another thread then returns.
    void kill() const { child_->kill(); }

    struct Result {
        std::string output;  // stdout
        std::string cause;   // in one line: an error from stderr, the signal or the exit code; empty after success
    };
    // Closes the pipe and waits for the child's end.
    Result finish();

private:
    double limit_;
    bool hung_ = false;
    Descriptor input_;
    MemoryFile output_;
    MemoryFile errors_;
    std::optional<ChildProcess> child_;
};

}  // namespace mandelmarch
