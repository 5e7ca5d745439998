// SPDX-License-Identifier: Apache-2.0
// The first thread of a team, where OpenMP binds threads (OMP_PROC_BIND).
#pragma once

#include <omp.h>
#include <sched.h>

#include <vector>

namespace mandelmarch::openmp {

// While it lives the calling thread stands on its place's cores, as its team's other threads stand on theirs; then it
// may run where it could before. The programs let go of the place that the run-time library has bound the first thread
// to (restore_affinity()), so that nothing else that this thread does or starts is bound.
class OwnPlace {
public:
    OwnPlace()
    {
        if (omp_get_num_places() == 0) return;  // nothing is bound
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
