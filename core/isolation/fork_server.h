// SPDX-License-Identifier: Apache-2.0
// Creates device processes. The fork server is forked while the program has no threads and no driver; each
// device process is forked from it, and so begins in that clean state, however long the program has run.
#pragma once

#include <sys/types.h>

#include <functional>
#include <initializer_list>
#include <mutex>

#include "core/isolation/channel.h"

namespace mandelmarch::isolation {

// A child process, as seen by the program.
struct Child {
    pid_t id = 0;
    Channel channel;  // to `work`
    Descriptor said;  // stdout and stderr of the process; non-blocking
};

class ForkServer {
public:
    // `work` runs in each process, with its end of a channel; when it returns, the process ends. The program must not
    // have threads. Throws Error.
    explicit ForkServer(const std::function<void(Channel)>& work);
    ~ForkServer();  // ends all its processes
    ForkServer(const ForkServer&) = delete;
    ForkServer& operator=(const ForkServer&) = delete;

    // Throws Error.
    Child start() const;

    // Ends the process, at once if `now`, otherwise after a short time to exit by itself. Returns how it ended: "exit
    // code 0", "signal 11 (Segmentation fault)".
    std::string end(pid_t child, bool now) const;

private:
    // Sends messages that belong together and returns the response.
    std::optional<Packet> ask(std::initializer_list<std::pair<std::string, int>> messages) const;

    Channel channel_;
    pid_t id_ = 0;
    mutable std::mutex mutex_;
};

}  // namespace mandelmarch::isolation
