// SPDX-License-Identifier: Apache-2.0
// Number of cores available to this process, and the process's affinity.
#pragma once

#include <optional>
#include <string>

namespace mandelmarch {

inline constexpr int most_threads = 1024;  // that a user may ask for

struct Cores {
    int machine = 1;                // online cores of the machine
    int given = 1;                  // cores assigned to the process at its start (taskset, cpusets, job schedulers)
    std::optional<double> quota{};  // processor_quota() of core/os/control_group.h; nullopt: no quota
    std::optional<int> asked{};     // first number in OMP_NUM_THREADS
    std::optional<int> limit{};     // OMP_THREAD_LIMIT

    // Returns the default number of threads: OMP_NUM_THREADS if it is set, otherwise the given cores, or fewer if the
    // quota allows fewer. The result is at most OMP_THREAD_LIMIT.
    int threads() const;
};

// Returns the cores of this process. `root` is the folder used as / in the search for control groups. Values of
// OpenMP's variables that GNU's run-time library of OpenMP ignores, with a line on stderr, are ignored. Throws
// InputError if OMP_NUM_THREADS asks for more than most_threads.
Cores cores(const std::string& root = {});

// Returns cores().threads(). Throws InputError.
int usable_threads();

// Returns the setting by which OpenMP binds its threads to cores, such as "OMP_PROC_BIND=true"; "" if it does not bind
// them. Reads OMP_PROC_BIND as GNU's library does, in capital or small letters.
std::string binding();

// Limits the threads of a driver that by default runs on all cores of the machine. If this process may use fewer cores,
// sets the environment variable `name` to usable_threads(), unless the variable is set already. Must be called before
// other threads run.
void limit_driver_threads(const char* name);

// Returns the number of different names of this process's threads that begin with `beginning`. Used for drivers that do
// not report their number of threads, and number the threads of each opened device from 0.
int threads_named(const std::string& beginning);

// Allows the calling thread, and the threads and processes that it starts later, to run on every core assigned to the
// process. OpenMP's run-time library may have bound the first thread to one core when the library was loaded.
void restore_affinity();

}  // namespace mandelmarch
