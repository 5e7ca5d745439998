// SPDX-License-Identifier: Apache-2.0
// Number of cores available to this process, and its affinity.
#pragma once

#include <optional>
#include <string>

namespace mandelmarch {

struct Cores {
    int machine = 1;                // all online cores
    int given = 1;                  // cores assigned to the process at its start (taskset, cpusets, job schedulers)
    std::optional<double> quota{};  // of the control groups: core/base/control_group.h
    std::optional<int> asked{};     // first number of OMP_NUM_THREADS
    std::optional<int> limit{};     // OMP_THREAD_LIMIT

    // Returns the default number of threads: OMP_NUM_THREADS if set, otherwise one per given core, limited by the
    // quota; in either case at most OMP_THREAD_LIMIT.
    int threads() const;
};

// `root`: the folder used as / in the search for control groups.
Cores cores(const std::string& root = {});

// Returns cores().threads().
int usable_threads();

// Returns the environment variable that makes OpenMP bind its threads, as "OMP_PROC_BIND=true"; "" if none does.
std::string binding();

// Limits drivers that run on the host's cores and use all cores of the machine by default. If this process may use
// fewer, sets the environment variable `name`, unless set, to usable_threads(). Call it before other threads run.
void limit_driver_threads(const char* name);

// Returns the number of this process's threads whose names begin with `beginning`, for drivers that do not report it.
int threads_named(const std::string& beginning);

// Lets the calling thread, and the threads and processes that it starts later, run on every core assigned to the
// process. OpenMP's run-time library may have bound the first thread to one core when it was loaded.
void restore_affinity();

}  // namespace mandelmarch
