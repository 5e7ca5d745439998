// SPDX-License-Identifier: Apache-2.0
// Creates device processes. The fork server is a process forked from the program before it has threads or drivers.
// Every device process is forked from the fork server, and so begins without threads and drivers, even after the
// program has started some.
#pragma once

#include <sys/types.h>

#include <functional>
#include <initializer_list>
#include <mutex>

#include "core/isolation/channel.h"

namespace mandelmarch::isolation {

// The program's handles of a device process.
struct Child {
    pid_t id = 0;
    Channel channel;    // connected to the function `work` in the process
    Descriptor output;  // pipe with the process's stdout and stderr; non-blocking
};

class ForkServer {
public:
    // Each device process calls `work` with its end of a channel, and ends when `work` returns. The program must not
    // have threads when this constructor is called. Throws Error.
    explicit ForkServer(const std::function<void(Channel)>& work);
    ~ForkServer();  // ends all device processes
    ForkServer(const ForkServer&) = delete;
    ForkServer& operator=(const ForkServer&) = delete;

    // Starts a device process. Throws Error.
    Child start() const;

    // Ends a process: at once if `now` is true, otherwise after giving it a short time to exit by itself. Returns how
    // it ended, such as "exit code 0" or "signal 11 (Segmentation fault)".
    std::string end(pid_t child, bool now) const;

private:
    // Sends messages that form one request, and returns the response; nullopt if the fork server has ended. Kills a
    // fork server that does not respond.
    std::optional<Packet> request(std::initializer_list<std::pair<std::string, int>> messages) const;

    Channel channel_;
    pid_t id_ = 0;
    mutable std::mutex mutex_;
};

}  // namespace mandelmarch::isolation
