// SPDX-License-Identifier: Apache-2.0
// Runs another program as a child process and reports its end, output and resource use.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <csignal>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/os/descriptor.h"
#include "core/os/stopwatch.h"
#include "core/os/temporary_path.h"

namespace mandelmarch {

// Returns the read end and the write end of a new pipe. Throws Error.
std::pair<Descriptor, Descriptor> make_pipe();

// An anonymous file in memory. It vanishes with its last descriptor.
class MemoryFile {
public:
    MemoryFile();  // throws Error

    int number() const { return descriptor_.number(); }
    // Returns the file's last bytes, at most `most`.
    std::string text(std::size_t most = std::string::npos) const;

private:
    Descriptor descriptor_;
};

// The program to start as a child process, and its settings. The caller keeps ownership of the descriptors.
struct ChildSetup {
    std::vector<std::string> words;        // name and arguments: argv
    std::string program = {};              // executable file; empty: words[0], searched in PATH in the caller's folder
    std::string folder = {};               // working directory; empty: the caller's
    int input = -1;                        // stdin; -1: /dev/null
    int output = -1;                       // stdout; -1: /dev/null
    int errors = -1;                       // stderr; -1: the caller's
    std::vector<std::string> hidden = {};  // beginnings of the environment variables that the child does not get
    bool confined = false;                 // files of at most 1 GiB, no core dumps
};

struct Ended {
    int code = 0;              // exit code, or 128 + the signal's number
    int signal = 0;            // signal that ended the child; 0: none
    bool timed_out = false;    // killed at the time limit
    double seconds = 0;        // wall time since the start
    double processor = 0;      // processor seconds, user and system, of the child and of the processes it waited for
    std::uint64_t memory = 0;  // bytes: peak resident set of the largest of these processes

    // Returns "exit code 0", "signal 11 (Segmentation fault)" and the like.
    std::string text() const;
};

// A child process, which leads a process group. The group is killed when the child ends, when the calling thread of the
// constructor ends (then only the child itself), and when SIGINT, SIGTERM or SIGHUP ends this program (KilledGroup).
class ChildProcess {
public:
    static constexpr double no_limit = std::numeric_limits<double>::infinity();

    // Throws Error if the program does not start.
    explicit ChildProcess(ChildSetup setup);
    // Takes over a process that the caller has forked, without its group.
    explicit ChildProcess(pid_t forked) : id_(forked) {}
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    // Waits at most `seconds` for the end. Returns false if the child still runs. Throws Error if the system does not
    // report how it ended.
    bool ends_within(double seconds);
    // Waits for the end; kills the child if it still runs after `seconds`.
    const Ended& end(double seconds = no_limit);
    // Kills the child without waiting. Any thread may call it.
    void kill() const { send(SIGKILL); }
    // Sends SIGINT, as Ctrl+C does.
    void interrupt() const { send(SIGINT); }

private:
    void take();
    void send(int signal) const;

    Clock::time_point start_ = Clock::now();
    pid_t id_;
    std::optional<KilledGroup> group_;
    std::optional<Ended> ended_;
};

}  // namespace mandelmarch
