// SPDX-License-Identifier: Apache-2.0
// Binds the first thread of a team to its cores, if OpenMP binds threads (OMP_PROC_BIND).
#pragma once

#include <omp.h>
#include <sched.h>

#include <vector>

namespace mandelmarch::openmp {

// Binds the calling thread to the cores of its OpenMP place, as OpenMP binds the other threads of its team to theirs.
// The destructor restores the thread's affinity. This class is needed, because the programs undo OpenMP's binding of
// their first thread when they start (restore_affinity()), so that this thread's other work and its child processes are
// not bound. A team of one thread is not bound, because the caller may run several such teams at the same time.
class OwnPlace {
public:
    explicit OwnPlace(int team)
    {
        const bool binds = omp_get_num_places() > 0;  // OpenMP binds threads
        if (team == 1 || !binds) return;
        bound_ = sched_getaffinity(0, sizeof before_, &before_) == 0;
        const int place = omp_get_place_num();
        if (place < 0 || !bound_) return;
        std::vector<int> cores(static_cast<std::size_t>(omp_get_place_num_procs(place)));
        omp_get_place_proc_ids(place, cores.data());
        cpu_set_t own;
        CPU_ZERO(&own);
        for (const int core : cores) CPU_SET(static_cast<std::size_t>(core), &own);
        sched_setaffinity(0, sizeof own, &own);
    }
    ~OwnPlace()
    {
        if (bound_) sched_setaffinity(0, sizeof before_, &before_);
    }
    OwnPlace(const OwnPlace&) = delete;
    OwnPlace& operator=(const OwnPlace&) = delete;

private:
    cpu_set_t before_{};
    bool bound_ = false;
};

}  // namespace mandelmarch::openmp
