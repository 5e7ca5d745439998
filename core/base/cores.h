// SPDX-License-Identifier: Apache-2.0
// The number of cores that this process may use, and its affinity.
#pragma once

#include <optional>
#include <string>

namespace mandelmarch {

struct Cores {
    int machine = 1;                // all cores that are switched on
    int given = 1;                  // those on which the process was started (taskset, cpusets, job schedulers)
    std::optional<double> quota{};  // of a control group: core/base/control_group.h
    std::optional<int> asked{};     // OMP_NUM_THREADS, its first number
    std::optional<int> limit{};     // OMP_THREAD_LIMIT

    // The number of threads unless an option sets it: OMP_NUM_THREADS if set, else one for each given core, but no more
    // than the quota can keep busy; in either case at most OMP_THREAD_LIMIT.
    int threads() const;
};

// `root`: the folder that stands for / in the search for control groups.
Cores cores(const std::string& root = {});

// cores().threads()
int usable_threads();

// The environment variable that makes OpenMP bind its threads, with its value: "OMP_PROC_BIND=true". Empty if none.
std::string binding();

// For drivers that draw on the host's cores and would use all cores of the machine: if this process may use fewer, sets
// the environment variable `name`, unless it is set, to usable_threads(). To be called before other threads run.
void limit_driver_threads(const char* name);

// The number of this process's threads whose names begin with `beginning`, for drivers that do not report the number.
int threads_named(const std::string& beginning);

// Lets the calling thread, and the threads and processes that it starts from now on, run on every core that the process
// was given. OpenMP's run-time library, once loaded, may have bound the first thread to one of them.
void restore_affinity();

}  // namespace mandelmarch
