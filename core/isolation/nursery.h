// SPDX-License-Identifier: Apache-2.0
// Where processes for devices come from. A nursery is forked off while the program has no threads and no driver; each
// process for a device is forked off the nursery, so that it begins as clean as that, however long the program runs.
#pragma once

#include <sys/types.h>

#include <functional>
#include <initializer_list>
#include <mutex>

#include "core/isolation/channel.h"

namespace mandelmarch::isolation {

// A process of its own, as the program sees it.
struct Child {
    pid_t id = 0;
    Channel channel;  // to `work`
    Descriptor said;  // what it writes on stdout and stderr; does not block
};

class Nursery {
public:
    // `work` is what each process does, with its end of a channel; when it returns, the process ends. The program must
    // have no threads. Throws Error.
    explicit Nursery(const std::function<void(Channel)>& work);
    ~Nursery();  // ends all of its processes
    Nursery(const Nursery&) = delete;
    Nursery& operator=(const Nursery&) = delete;

    // Throws Error.
    Child start() const;

    // Ends the process, `now` or if it has not ended by itself a moment later, and tells how it ended in words: "exit
    // code 0", "signal 11 (Segmentation fault)".
    std::string end(pid_t child, bool now) const;

private:
    // What it answers to messages that belong together.
    std::optional<Packet> ask(std::initializer_list<std::pair<std::string, int>> messages) const;

    Channel channel_;
    pid_t id_ = 0;
    mutable std::mutex mutex_;
};

}  // namespace mandelmarch::isolation
