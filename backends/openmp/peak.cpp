// SPDX-License-Identifier: Apache-2.0
#include "backends/openmp/peak.h"

#include <omp.h>

#include "backends/openmp/instructions.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/render/peak.h"

namespace mandelmarch::openmp {

double multiply_add_peak(Precision precision, int threads)
{
    const PeakKernel kernel =
        precision == Precision::f32 ? peak_kernel_float(instructions()) : peak_kernel_double(instructions());
    const int team = threads == 0 ? omp_get_num_procs() : threads;
    const PeakRun run = [&](int rounds) {
        const auto start = Clock::now();
        double sum = 0;
#pragma omp parallel num_threads(team) reduction(+ : sum)
        sum += kernel.run(rounds);
        const double seconds = seconds_since(start);
        if (!(sum > 0)) throw Error("backend openmp: the multiply-add kernel computes nonsense");
        return seconds;
    };
    return highest_rate(run, static_cast<double>(kernel.lanes) * team);
}

}  // namespace mandelmarch::openmp
