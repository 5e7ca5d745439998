// SPDX-License-Identifier: Apache-2.0
// The OpenCL backend: the kernel on any OpenCL 1.2 device, in vectors on CPUs that have vector units.
#include <fmt/format.h>

#include <algorithm>

#include "backends/opencl/executor.h"
#include "core/os/files.h"
#include "core/os/memory.h"
#include "core/render/peak.h"
#include "core/render/spacing.h"
#include "core/scene/fractal.h"
#include "core/text/environment.h"

namespace mandelmarch {
namespace opencl {
namespace {

class OpenclRenderer : public Renderer {
public:
    OpenclRenderer(const cl::Device& device, const RendererOptions& options)
        : options_(options), build_(build_for(device, options)), session_(std::make_unique<Session>())
    {
        checked("opening the device", [&] {
            const Clock::time_point start = Clock::now();
            session_->device = device;
            session_->context = cl::Context(device);
            session_->queue = cl::CommandQueue(session_->context, device, CL_QUEUE_PROFILING_ENABLE);
            session_->is_cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
            session_->largest_buffer = static_cast<std::int64_t>(
                std::min<cl_ulong>(device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(), std::int64_t{1} << 40));
            context_seconds_ = seconds_since(start);
        });
    }

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        try {
            return checked("drawing", [&] {
                return options_.precision == Precision::f32 ? render_as<float>(scene, image, progress)
                                                            : render_as<double>(scene, image, progress);
            });
        } catch (const DeviceHung&) {
            // The device may still use the session's objects, so they are not released before the process ends.
            static_cast<void>(session_.release());
            throw;
        }
    }

private:
    template <class Real>
    RenderStats render_as(const Scene& scene, Image& image, const Progress& progress)
    {
        const Clock::time_point start = Clock::now();
        const bool first = !session_->programs.contains(scene.fractal->name);
        cl::Program& program = compiled(scene.fractal->name);
        // All planes of reals of a band are in one buffer, whose size the device limits.
        const std::int64_t most = session_->largest_buffer / static_cast<std::int64_t>(real_planes * sizeof(Real));
        Limits limits = with_band(
            {.pixels_per_band = std::min(most, largest_band),
             .pixels_to_fill = session_->is_cpu ? busy_cpu(scene.iterations) : pixels_of_gpu(items_of_unit * units())},
            options_.band);
        limits.starts = starts_for<Real>(scene);
        // The executor is allocated on the heap, so that it can be abandoned while a device that hangs still uses it.
        auto executor = std::make_unique<BandExecutor<Real>>(*session_, program, build_, scene, options_, limits,
                                                             bytes_alone(image, options_));
        double build_seconds = 0;
        try {
            if (first) {
                executor->warm_up();
                build_seconds = seconds_since(start) - executor->timings.upload;
            }
            run_schedule(scene, options_.mode, limits, *executor, image, progress);
        } catch (const DeviceHung&) {
            static_cast<void>(executor.release());
            throw;
        }
        RenderStats report{.backend = "opencl",
                           .device = description(session_->device),
                           .precision = options_.precision,
                           .mode = options_.mode,
                           .threads = session_->is_cpu ? static_cast<int>(units()) : 1,
                           .simd_width = build_.lanes,
                           .instruction_set = {},
                           .timings = executor->timings,
                           .work = executor->work};
        report.timings.context = context_seconds_;
        report.timings.build = build_seconds;
        report.timings.wall = seconds_since(start);
        return report;
    }

    // Returns the passes that find where rays begin. Vectors refill their lanes, so that the steps saved by neighbours
    // save time; on a GPU, a warp waits for its slowest ray.
    template <class Real>
    Starts starts_for(const Scene& scene) const
    {
        const auto kernel = kernel_scene<KernelScene<Real>>(scene, options_.mode, options_.techniques);
        return starts_of(kernel, *scene.fractal, options_.techniques, session_->is_cpu ? subtile_side : gpu_cone_side,
                         0, session_->is_cpu && build_.lanes > 1);
    }

    cl_uint units() const { return session_->device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>(); }

    cl::Program& compiled(std::string_view fractal)
    {
        if (const auto found = session_->programs.find(fractal); found != session_->programs.end()) {
            return found->second;
        }
        const std::string_view* const text = program_text(fractal);
        if (text == nullptr) throw Unavailable(fmt::format("backend opencl: it does not draw the {}", fractal));
        cl::Program program(session_->context, std::string(*text));
        const cl_int code = clBuildProgram(program(), 1, &session_->device(), build_.options.c_str(), nullptr, nullptr);
        if (code == CL_BUILD_PROGRAM_FAILURE) {
            std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(session_->device);
            std::ranges::replace(log, '\n', ' ');
            throw Error(fmt::format("backend opencl: the kernel does not compile: {}", log.substr(0, 500)));
        }
        if (code != CL_SUCCESS) throw cl::Error(code, "clBuildProgram");
        return session_->programs.emplace(fractal, std::move(program)).first->second;
    }

    // Returns the pixels of a band of a CPU. Bands are large, because at the end of each one vectors run out of rays.
    // With many iterations a pixel they are smaller, because a picture can be cancelled only between bands.
    static std::int64_t busy_cpu(int iterations)
    {
        constexpr std::int64_t iterations_of_band = 1 << 26;
        return std::clamp<std::int64_t>(iterations_of_band / iterations, 1 << 17, 1 << 21);
    }
    // OpenCL does not report how many work items a compute unit holds; 2048 is the value of many NVIDIA GPUs.
    static constexpr std::int64_t items_of_unit = 2048;

    RendererOptions options_;
    Build build_;
    std::unique_ptr<Session> session_;
    double context_seconds_ = 0;
};

constexpr const char* peak_text =
#include "peak.txt"
    ;

// Work items per compute unit that measure the multiply-add peak: on a GPU enough to fill the unit with threads, on a
// CPU enough to keep all cores busy.
constexpr std::size_t items_per_gpu_unit = 2048;
constexpr std::size_t items_per_cpu_unit = 16;

template <class Real>
double measured_peak(const cl::Device& device, const Build& build)
{
    cl::Context context(device);
    cl::CommandQueue queue(context, device);
    cl::Program program(context, peak_text);
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

// Returns the reason why a list of devices is empty. Throws Error if the system refuses what a driver needs.
std::string no_device()
{
    refuse_shortage("backend opencl: listing devices");
    return "no OpenCL device: no driver is installed, such as pocl-opencl-icd for the CPU, or it has no device";
}

class OpenclBackend : public Backend {
public:
    std::string_view name() const override { return "opencl"; }
    BackendInfo info() const override
    {
        return {.title = "OpenCL",
                .distribution = "one work item per pixel on a GPU, per strip of pixels (in vectors) on a CPU",
                .has_driver = true,
                .simd_width = true,
                .band = true,
                .block_size = true,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }

    // Each file in the vendors folder contains the name of a driver's library.
    std::vector<InstalledDriver> installed_drivers() const override
    {
        std::vector<InstalledDriver> found;
        const std::string vendors = environment_variable("OCL_ICD_VENDORS");
        for (const std::string& path : files_in(vendors.empty() ? "/etc/OpenCL/vendors" : vendors)) {
            found.push_back({"opencl", path, first_line(path), ""});
        }
        found.push_back({"loader", "libOpenCL.so.1", "libOpenCL.so.1", ""});
        return found;
    }

    std::optional<std::string> unavailable() const override
    {
        if (!all_devices().empty()) return std::nullopt;
        return no_device();
    }

    std::vector<Device> devices() const override
    {
        std::vector<Device> devices;
        for (const cl::Device& device : all_devices()) devices.push_back(description(device));
        return devices;
    }

    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        return std::make_unique<OpenclRenderer>(device_of(options), options);
    }

    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        // Fast mode allows the compiler to use the device's multiply-add instruction.
        RendererOptions fast = options;
        fast.mode = Mode::fast;
        fast.simd_width = 0;
        const cl::Device device = device_of(options);
        const Build build = build_for(device, fast);
        return checked("measuring the multiply-add peak", [&] {
            return options.precision == Precision::f32 ? measured_peak<float>(device, build)
                                                       : measured_peak<double>(device, build);
        });
    }

private:
    cl::Device device_of(const RendererOptions& options) const
    {
        const auto devices = all_devices();
        if (devices.empty()) throw Unavailable("backend opencl: " + no_device());
        const auto index = static_cast<std::size_t>(options.device);
        if (index >= devices.size()) {
            throw Unavailable(fmt::format("backend opencl: there is no device {}, only {} of them, from 0",
                                          options.device, devices.size()));
        }
        return devices[index];
    }
};

}  // namespace
}  // namespace opencl

std::unique_ptr<Backend> make_opencl_backend() { return std::make_unique<opencl::OpenclBackend>(); }

}  // namespace mandelmarch
