// SPDX-License-Identifier: Apache-2.0
// A device's process, as the program sees it.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "core/isolation/codec.h"
#include "core/isolation/nursery.h"

namespace mandelmarch::isolation {

class Process {
public:
    // `name` is what messages call it, "backend opencl: device 0".
    Process(std::shared_ptr<const Nursery> nursery, std::string name);
    ~Process();  // ends it
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    // Sends a request and waits for its answer; `doing` is for messages: "drawing". What the process prints goes to
    // stderr. Throws what the backend there throws; Error where the process ends, and DeviceHung where nothing is heard
    // for longer than device_timeout(): the process has then been ended, and has_ended() is true. Cancelled: the
    // process has been told after a sign of life, and has answered.
    Reader ask(const Writer& request, const char* doing, int descriptor = -1, const Progress& progress = {});
    // Sends what is not answered.
    void tell(const Writer& request);

    bool has_ended() const { return ended_; }

private:
    // The next message; nullopt where the process has ended. Throws DeviceHung.
    std::optional<Packet> heard(const char* doing);
    void listen();                                      // takes what the process has printed
    void log(std::string_view text);                    // appends it to the file that MANDELMARCH_DRIVER_LOG names
    void repeat_said();                                 // prints it
    std::string end(bool now = false);                  // how it ended
    bool told(const Progress& progress, double share);  // false: cancelled, and the process knows
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
