// SPDX-License-Identifier: Apache-2.0
// How many cores this process may use, and on which it may run.
#pragma once

#include <optional>
#include <string>

namespace mandelmarch {

struct Cores {
    int machine = 1;              // that are switched on
    int given = 1;                // of them those that the process was started on (taskset, cpusets, job schedulers)
    std::optional<double> quota;  // of a control group: core/base/control_group.h
    std::optional<int> asked;     // OMP_NUM_THREADS, its first number
    std::optional<int> limit;     // OMP_THREAD_LIMIT

    // Threads that work at once, where no option says how many: those that OMP_NUM_THREADS asks for, or one for each
    // core given, but no more than the quota can keep busy; in either case at most OMP_THREAD_LIMIT.
    int threads() const;
};

// `root`: the folder that stands for / where control groups are looked up.
Cores cores(const std::string& root = {});

// cores().threads()
int usable_threads();

// The variable by which the environment has OpenMP bind its threads to places, "OMP_PROC_BIND=true", or nothing.
std::string binding();

// For drivers that draw on the host's cores and look at the machine's alone: where this process may use fewer, sets the
// environment's variable `name`, unless it is set, to usable_threads(). To be called before other threads run.
void limit_driver_threads(const char* name);

// How many of this process's threads have names that begin so: those of a driver's that tells their number nowhere.
int threads_named(const std::string& beginning);

// Lets the calling thread, and the threads and processes that it starts from now on, run on every core that the process
// was given. OpenMP's run-time library, once loaded, may have bound the first thread to one of them.
void restore_affinity();

}  // namespace mandelmarch
