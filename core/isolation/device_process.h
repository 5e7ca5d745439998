// SPDX-License-Identifier: Apache-2.0
// Both sides of the connection between a program and a device process.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "core/isolation/fork_server.h"
#include "core/isolation/message.h"

namespace mandelmarch::isolation {

// The device process's side (worker.cpp): serves requests with the backend until the program closes the channel, then
// ends the process.
[[noreturn]] void serve(const Backend& backend, const Channel& channel);

// The program's side.
class DeviceProcess {
public:
    // Messages begin with `name`, such as "backend opencl: device 0".
    DeviceProcess(std::shared_ptr<const ForkServer> fork_server, std::string name);
    ~DeviceProcess();  // ends the process
    DeviceProcess(const DeviceProcess&) = delete;
    DeviceProcess& operator=(const DeviceProcess&) = delete;

    // Sends a request and waits for the response; messages name the action `doing`, such as "drawing". Prints the
    // process's output to stderr. Rethrows exceptions of the backend. Throws Error if the process ends. If the process
    // sends nothing for longer than device_timeout(), ends it and throws DeviceHung; has_ended() then returns true. If
    // `progress` throws Cancelled, sends Request::cancel, waits for the response, and throws Cancelled.
    Deserializer request(const Serializer& message, const char* doing, int descriptor = -1,
                         const Progress& progress = {});
    // Sends a request that has no response.
    void send(const Serializer& message);

    bool has_ended() const { return ended_; }

private:
    // Waits for the next message and returns it; nullopt if the process has ended. Throws DeviceHung.
    std::optional<Packet> receive(const char* doing);
    void read_output();                 // reads the process's output and stores it
    void log(std::string_view text);    // appends to the file named by MANDELMARCH_DRIVER_LOG
    void print_output();                // prints the stored output to stderr
    std::string end(bool now = false);  // ends the process; returns how it ended
    // Calls `progress`. If it cancels, requests the same from the process, and returns false.
    bool continues(const Progress& progress, double share);
    [[noreturn]] void fail(Response kind, Deserializer& response, const char* doing);

    std::shared_ptr<const ForkServer> fork_server_;
    std::string name_;
    Descriptor log_;
    Child child_;
    Descriptor life_;     // becomes readable when the process ends; empty: not supported
    std::string output_;  // what the process has printed
    bool ended_ = false;
    std::mutex mutex_;  // allows one request at a time
};

}  // namespace mandelmarch::isolation
