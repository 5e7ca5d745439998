// SPDX-License-Identifier: Apache-2.0
// A device process, as seen by the program.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "core/isolation/codec.h"
#include "core/isolation/fork_server.h"

namespace mandelmarch::isolation {

class DeviceProcess {
public:
    // `name` is used in messages, such as "backend opencl: device 0".
    DeviceProcess(std::shared_ptr<const ForkServer> fork_server, std::string name);
    ~DeviceProcess();  // ends the process
    DeviceProcess(const DeviceProcess&) = delete;
    DeviceProcess& operator=(const DeviceProcess&) = delete;

    // Sends a request and waits for its response; `doing` is used in messages, such as "drawing". Output of the process
    // is printed to stderr. Rethrows exceptions of the backend. Throws Error if the process ends, and DeviceHung if it
    // sends nothing for longer than device_timeout(): the process is then ended and has_ended() is true. Cancelled is
    // thrown after the process has received the cancellation, following a progress message, and has responded.
    Deserializer ask(const Serializer& request, const char* doing, int descriptor = -1, const Progress& progress = {});
    // Sends a request without a response.
    void tell(const Serializer& request);

    bool has_ended() const { return ended_; }

private:
    // Returns the next message; nullopt if the process has ended. Throws DeviceHung.
    std::optional<Packet> heard(const char* doing);
    void listen();                                      // reads the output of the process
    void log(std::string_view text);                    // appends to the file in MANDELMARCH_DRIVER_LOG
    void repeat_said();                                 // prints the output of the process
    std::string end(bool now = false);                  // returns how it ended
    bool told(const Progress& progress, double share);  // false: cancelled, and the process was notified
    [[noreturn]] void fail(Answer kind, Deserializer& answer, const char* doing);

    std::shared_ptr<const ForkServer> fork_server_;
    std::string name_;
    Child child_;
    std::string said_;
    Descriptor log_;
    bool ended_ = false;
    std::mutex mutex_;  // one request at a time
};

}  // namespace mandelmarch::isolation
