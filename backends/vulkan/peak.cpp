// SPDX-License-Identifier: Apache-2.0
#include "backends/vulkan/peak.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "backends/vulkan/executor.h"
#include "core/render/peak.h"

namespace mandelmarch::vulkan {
namespace {

constexpr int group = 64;  // invocations per work group, as in peak.comp
// Number of invocations: on a GPU several for each lane of the largest GPUs, on a CPU enough to keep all cores busy.
constexpr int gpu_items = 1 << 21;
constexpr int cpu_items = 1 << 12;
// Loop iterations of an invocation in one pass. Limited, because a watchdog may end a GPU's pass after several seconds.
constexpr int rounds_per_pass = 1 << 14;
static_assert(rounds_per_pass < counted_loops / 2);

template <class Real>
double measured(Gpu& gpu, Workbench& bench, Precision precision)
{
    const int items = gpu.info().device.is_gpu ? gpu_items : cpu_items;
    bench.program = std::make_unique<Program>(gpu, module_named(fmt::format("peak_{}_fast", name_of(precision))), 2);
    bench.buffers.push_back(gpu.make_buffer(sizeof(Real) * items, Place::device, "sums"));
    bench.buffers.push_back(gpu.make_buffer(2 * sizeof(Real), Place::host, "two numbers"));
    const Real given[2] = {static_cast<Real>(peak_factor), static_cast<Real>(peak_addend)};
    std::memcpy(bench.buffers[1].bytes, given, sizeof(given));
    bench.program->bind(
        std::array{Binding{&bench.buffers[0], 0, VK_WHOLE_SIZE}, Binding{&bench.buffers[1], 0, VK_WHOLE_SIZE}});
    const PeakRun run = [&](int rounds) {
        const auto start = Clock::now();
        for (int left = rounds; left > 0; left -= rounds_per_pass) {
            bench.program->dispatch(gpu, {}, {std::min(left, rounds_per_pass)},
                                    static_cast<std::uint32_t>(items / group), 1);
            gpu.barrier();
        }
        gpu.finish("measuring the multiply-add peak");
        return seconds_since(start);
    };
    return highest_rate(run, items);
}

}  // namespace

double multiply_add_peak(const RendererOptions& options)
{
    const Instance instance;
    if (static_cast<std::size_t>(options.device) >= instance.devices().size()) {
        throw Unavailable(fmt::format("backend vulkan: there is no device {}", options.device));
    }
    // Allocated separately, so that they can be left in use if the device hangs.
    auto gpu = std::make_unique<Gpu>(instance.devices()[static_cast<std::size_t>(options.device)], options.precision);
    auto bench = std::make_unique<Workbench>();
    try {
        return attempt(gpu->name(), "measuring the multiply-add peak", [&] {
            return options.precision == Precision::f32 ? measured<float>(*gpu, *bench, options.precision)
                                                       : measured<double>(*gpu, *bench, options.precision);
        });
    } catch (const DeviceHung&) {
        static_cast<void>(bench.release());
        static_cast<void>(gpu.release());
        throw;
    }
}

}  // namespace mandelmarch::vulkan
