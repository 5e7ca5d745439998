// SPDX-License-Identifier: Apache-2.0
#include "backends/openacc/peak.h"

#include "backends/openacc/device.h"
#include "core/base/stopwatch.h"
#include "core/render/peak.h"

extern "C" {
void multiply_adds_float(void* sums, int threads, float a, float b, int rounds);
void multiply_adds_double(void* sums, int threads, double a, double b, int rounds);
}

namespace mandelmarch::openacc {
namespace {

// Several for each lane of the largest GPUs; the host works on one after the other.
constexpr int gpu_threads = 1 << 21;
constexpr int host_threads = 1 << 7;

}  // namespace

double multiply_add_peak(const Device& device, Precision precision)
{
    const int threads = device.is_gpu ? gpu_threads : host_threads;
    const DeviceMemory sums(static_cast<std::size_t>(threads) * sizeof(double));
    const PeakRun run = [&](int rounds) {
        const auto start = Clock::now();
        if (precision == Precision::f32) {
            multiply_adds_float(sums.address(), threads, static_cast<float>(peak_factor),
                                static_cast<float>(peak_addend), rounds);
        } else {
            multiply_adds_double(sums.address(), threads, peak_factor, peak_addend, rounds);
        }
        return seconds_since(start);
    };
    return highest_rate(run, threads);
}

}  // namespace mandelmarch::openacc
