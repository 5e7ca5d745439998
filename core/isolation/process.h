// SPDX-License-Identifier: Apache-2.0
// A device process, as seen by the program.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "core/isolation/codec.h"
#include "core/isolation/nursery.h"

namespace mandelmarch::isolation {

class Process {
public:
    // `name` is used in messages, such as "backend opencl: device 0".
    Process(std::shared_ptr<const Nursery> nursery, std::string name);
    ~Process();  // ends the process
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    // Sends a request and waits for its response; `doing` is used in messages, such as "drawing". Output of the process
    // is printed to stderr. Rethrows exceptions of the backend. Throws Error if the process ends, and DeviceHung if it
    // sends nothing for longer than device_timeout(): the process is then ended and has_ended() is true. Cancelled is
    // thrown after the process has received the cancellation, following a progress message, and has responded.
    Reader ask(const Writer& request, const char* doing, int descriptor = -1, const Progress& progress = {});
    // Sends a request without a response.
    void tell(const Writer& request);

    bool has_ended() const { return ended_; }

private:
    // Returns the next message; nullopt if the process has ended. Throws DeviceHung.
    std::optional<Packet> heard(const char* doing);
    void listen();                                      // reads the output of the process
    void log(std::string_view text);                    // appends to the file in MANDELMARCH_DRIVER_LOG
    void repeat_said();                                 // prints the output of the process
    std::string end(bool now = false);                  // returns how it ended
    bool told(const Progress& progress, double share);  // false: cancelled, and the process was notified
    [[noreturn]] void fail(Answer kind, Reader& answer, const char* doing);

    std::shared_ptr<const Nursery> nursery_;
    std::string name_;
    Child child_;
    std::string said_;
    Descriptor log_;
    bool ended_ = false;
    std::mutex mutex_;  // one request at a time
};

}  // namespace mandelmarch::isolation
