// SPDX-License-Identifier: Apache-2.0
#include "backends/openmp/peak.h"

#include <omp.h>

#include "backends/openmp/place.h"
#include "backends/openmp/variants.h"
#include "core/base/cores.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/render/peak.h"

namespace mandelmarch::openmp {

double multiply_add_peak(Precision precision, int threads)
{
    const PeakKernel kernel =
        precision == Precision::f32 ? peak_kernel_float(instructions()) : peak_kernel_double(instructions());
    const OwnPlace place;
    const int asked = threads == 0 ? usable_threads() : threads;
    const PeakRun run = [&](int rounds) {
        const auto start = Clock::now();
        double sum = 0;
        int team = 1;
#pragma omp parallel num_threads(asked) reduction(+ : sum) reduction(max : team)
        {
            team = omp_get_num_threads();
            sum += kernel.run(rounds);
        }
        // If OMP_THREAD_LIMIT or OMP_DYNAMIC makes the team smaller than requested, it does only a part of the work.
        // The time is scaled to that of the whole work.
        const double seconds = seconds_since(start) * asked / team;
        if (!(sum > 0)) throw Error("backend openmp: the multiply-add kernel computes nonsense");
        return seconds;
    };
    return highest_rate(run, static_cast<double>(kernel.lanes) * asked);
}

}  // namespace mandelmarch::openmp
