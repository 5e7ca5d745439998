// SPDX-License-Identifier: Apache-2.0
// A child process that reads its input from a pipe. It is used for ffmpeg.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mandelmarch {

// The constructor starts the process. Its standard output and its errors are collected in memory.
class ChildProcess {
public:
    // `folder`: working directory; empty: the caller's. `limit`: seconds; a child that does not read or does not end
    // for that long is killed, and finish() reports it. Without a limit, write() and finish() may block for ever.
    // Throws Error if the child cannot be started.
    ChildProcess(const std::vector<std::string>& command, const std::string& folder,
                 std::optional<double> limit = std::nullopt);
    ~ChildProcess();  // kills a child that still runs, and waits for it
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    // Passes the data to the child. Returns false if the child has stopped reading; finish() then reports the cause.
    bool write(const void* data, std::size_t size);
    // Kills the child. A write() that blocks in another thread then returns.
    void kill();

    struct Result {
        bool ok = false;
        std::string output;  // stdout
        std::string cause;   // one line: an error from stderr, the signal or the exit code; empty if `ok`
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
