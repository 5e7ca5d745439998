// SPDX-License-Identifier: Apache-2.0
#include "backends/opencl/peak.h"

#include "core/base/stopwatch.h"
#include "core/render/peak.h"

namespace mandelmarch::opencl {
namespace {

constexpr const char* text =
#include "peak.txt"
    ;

// Work items per compute unit: on a GPU enough to fill it with threads, on a CPU enough to keep all cores busy.
constexpr std::size_t items_per_gpu_unit = 2048;
constexpr std::size_t items_per_cpu_unit = 16;

template <class Real>
double measured(const cl::Device& device, const Build& build)
{
    cl::Context context(device);
    cl::CommandQueue queue(context, device);
    cl::Program program(context, text);
    program.build({device}, build.options.c_str());
    cl::Kernel kernel(program, "multiply_adds");
    const bool is_cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    const std::size_t items =
        device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>() * (is_cpu ? items_per_cpu_unit : items_per_gpu_unit);
    cl::Buffer sums(context, CL_MEM_READ_WRITE, items * sizeof(Real));
    kernel.setArg(0, sums);
    kernel.setArg(1, static_cast<Real>(peak_factor));
    kernel.setArg(2, static_cast<Real>(peak_addend));
    const PeakRun run = [&](int rounds) {
        kernel.setArg(3, rounds);
        const auto start = Clock::now();
        queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), is_cpu ? cl::NDRange(1) : cl::NullRange);
        queue.finish();
        return seconds_since(start);
    };
    return highest_rate(run, static_cast<double>(items) * build.lanes);
}

}  // namespace

double multiply_add_peak(const cl::Device& device, const RendererOptions& options)
{
    // Fast mode allows the compiler to use the device's multiply-add instruction.
    RendererOptions fast = options;
    fast.mode = Mode::fast;
    fast.simd_width = 0;
    const Build build = build_for(device, fast);
    return checked("measuring the multiply-add peak", [&] {
        return options.precision == Precision::f32 ? measured<float>(device, build) : measured<double>(device, build);
    });
}

}  // namespace mandelmarch::opencl
