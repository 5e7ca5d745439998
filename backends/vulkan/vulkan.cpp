// SPDX-License-Identifier: Apache-2.0
// The Vulkan backend: the kernel as SPIR-V compute shaders, on GPUs, and on CPUs through lavapipe.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "backends/vulkan/executor.h"
#include "core/os/cores.h"
#include "core/os/files.h"
#include "core/render/peak.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace vulkan {
namespace {

// The Vulkan objects of a renderer or a measurement. They are destroyed in reverse order of their declaration.
struct Session {
    Instance instance;
    Gpu gpu;
    Workbench bench;

    explicit Session(const RendererOptions& options) : gpu(chosen(instance, options.device), options.precision) {}

    static const vk::raii::PhysicalDevice& chosen(const Instance& instance, int index)
    {
        const std::size_t count = instance.devices().size();
        if (static_cast<std::size_t>(index) < count) return instance.devices()[static_cast<std::size_t>(index)];
        throw Unavailable(
            fmt::format("backend vulkan: there is no device {}, the last is device {}", index, count - 1));
    }
};

// Opens the device of the options. Throws Unavailable if it does not exist or does not support the options.
std::unique_ptr<Session> opened(const RendererOptions& options)
{
    try {
        return std::make_unique<Session>(options);
    } catch (const Unavailable& unavailable) {
        const std::string why = unavailable.what();
        throw Unavailable(why.starts_with("backend ") ? why : "backend vulkan: " + why);
    }
}

// Runs f. If the device does not respond, abandons it with all objects that it may still use, because their destruction
// would block.
template <class Function>
void guarded(std::unique_ptr<Session>& session, Function f)
{
    try {
        f();
    } catch (const DeviceHung&) {
        static_cast<void>(session.release());
        throw;
    } catch (...) {
        session->gpu.discard();
        throw;
    }
}

class VulkanRenderer : public Renderer {
public:
    explicit VulkanRenderer(const RendererOptions& options) : options_(options)
    {
        const auto start = Clock::now();
        session_ = opened(options);
        variant_ = fmt::format("{}_{}", name_of(options.precision), name_of(options.mode));
        guarded(session_, [&] {
            if (options.mode == Mode::exact) {
                const std::string ending = exact_modules(session_->gpu, session_->bench, options.precision);
                session_->bench = {};
                variant_ += ending;
                instruction_set_ = ending.empty() ? "SPIR-V" : "SPIR-V, float quotients corrected";
            }
        });
        context_ = seconds_since(start);
    }

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        if (session_ == nullptr) throw Error("backend vulkan: the device did not answer before and was given up");
        RenderStats report;
        guarded(session_, [&] {
            report = options_.precision == Precision::f32 ? render_as<float>(scene, image, progress)
                                                          : render_as<double>(scene, image, progress);
        });
        return report;
    }

private:
    template <class Real>
    RenderStats render_as(const Scene& scene, Image& image, const Progress& progress)
    {
        const auto start = Clock::now();
        Gpu& gpu = session_->gpu;
        const auto kernel = kernel_scene<KernelScene<Real>>(scene, options_.mode, options_.techniques);
        const Limits limits = limits_of(scene, kernel, gpu.info(), options_);
        const auto pixels =
            static_cast<vk::DeviceSize>(rows_per_band(scene, limits)) * static_cast<vk::DeviceSize>(scene.width);
        RenderStats report{.backend = "vulkan",
                           .device = gpu.info().device,
                           .precision = options_.precision,
                           .mode = options_.mode,
                           // lavapipe does not report its number of threads, so they are counted by their names.
                           .threads = gpu.info().counts_loops ? std::max(1, threads_named("llvmpipe-")) : 1,
                           .instruction_set = instruction_set_,
                           .timings = {},
                           .work = {}};
        Timings& timings = report.timings;
        timings.context = context_;
        if (loaded_ != scene.fractal->name) {
            const auto build = Clock::now();
            load(scene.fractal->name);
            timings.build = seconds_since(build);
        }

        const auto upload = Clock::now();
        bind_buffers<Real>(
            pixels, std::max<vk::DeviceSize>(1, cones_of(limits.starts, scene.width, rows_per_band(scene, limits))));
        gpu.commands().updateBuffer<KernelScene<Real>>(*session_->bench.buffers[scene_buffer].handle, 0, kernel);
        gpu.barrier();
        timings.upload = seconds_since(upload);

        BandExecutor<Real> executor(gpu, session_->bench, kernel, limits.starts, pixels, bytes_alone(image, options_),
                                    timings);
        run_schedule(scene, options_.mode, limits, executor, image, progress);
        report.work = executor.work();
        timings.wall = seconds_since(start);
        return report;
    }

    // Loads the fractal's program into the Workbench.
    void load(std::string_view fractal)
    {
        const Module module = module_named(fmt::format("{}_{}", fractal, variant_));
        if (module.empty()) throw Unavailable(fmt::format("backend vulkan: it has no fractal {}", fractal));
        loaded_.clear();
        session_->bench.program = std::make_unique<Program>(session_->gpu, module, 7);
        loaded_ = fractal;
    }

    // Binds buffers for bands of `pixels` pixels with `tiles` cones. Reuses the buffers of earlier pictures if they are
    // large enough.
    template <class Real>
    void bind_buffers(vk::DeviceSize pixels, vk::DeviceSize tiles)
    {
        using Bands = BandExecutor<Real>;
        auto& buffers = session_->bench.buffers;
        if (held_ < pixels || held_tiles_ < tiles) {
            const vk::DeviceSize most = std::max(pixels, held_);
            const vk::DeviceSize most_tiles = std::max(tiles, held_tiles_);
            const Gpu& gpu = session_->gpu;
            const bool shared = gpu.info().shares_memory;
            const vk::DeviceSize size = Bands::results_size(most);
            held_ = 0;
            buffers.clear();
            buffers.push_back(gpu.make_buffer(sizeof(KernelScene<Real>), Place::device, "the scene"));
            buffers.push_back(gpu.make_buffer(ray_size(sizeof(Real)) * most, Place::device, "rays"));
            buffers.push_back(gpu.make_buffer(size, shared ? Place::host : Place::device, "pixels"));
            buffers.push_back(gpu.make_buffer(sizeof(Real) * most_tiles, Place::device, "starts of rays"));
            buffers.push_back(gpu.make_buffer(2 * sizeof(int) * most_tiles, Place::host, "the work of cones"));
            if (!shared) buffers.push_back(gpu.make_buffer(size, Place::host, "copies of the pixels"));
            held_ = most;
            held_tiles_ = most_tiles;
        }
        const Buffer* results = &buffers[result_buffer];
        session_->bench.program->bind(std::array{
            Binding{&buffers[scene_buffer], 0, VK_WHOLE_SIZE}, Binding{&buffers[ray_buffer], 0, VK_WHOLE_SIZE},
            Binding{results, reals_at, real_planes * sizeof(Real) * pixels},
            Binding{results, Bands::wholes_at(pixels), Bands::wholes_size(pixels)}, Binding{results, 0, flags_size},
            Binding{&buffers[start_buffer], 0, VK_WHOLE_SIZE}, Binding{&buffers[cone_work_buffer], 0, VK_WHOLE_SIZE}});
    }

    RendererOptions options_;
    std::unique_ptr<Session> session_;
    std::string variant_;                     // suffix of the modules' names
    std::string instruction_set_ = "SPIR-V";  // for the user; names the method of float divisions, too
    std::string loaded_;                      // name of the fractal whose program is loaded
    vk::DeviceSize held_ = 0;                 // pixels that the Workbench's buffers can hold
    vk::DeviceSize held_tiles_ = 0;           // and cones
    double context_ = 0;                      // seconds
};

constexpr int group = 64;  // invocations per work group, as in peak.comp
// Number of invocations that measure the multiply-add peak: on a GPU several for each lane of the largest GPUs, on a
// CPU enough to keep all cores busy.
constexpr int gpu_items = 1 << 21;
constexpr int cpu_items = 1 << 12;
// Loop iterations of an invocation in one pass. Limited, because a watchdog may end a GPU's pass after several seconds.
constexpr int rounds_per_pass = 1 << 14;
static_assert(rounds_per_pass < counted_loops / 2);

template <class Real>
double measured_peak(Session& session, Precision precision)
{
    Gpu& gpu = session.gpu;
    Workbench& bench = session.bench;
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

class VulkanBackend : public Backend {
public:
    std::string_view name() const override { return "vulkan"; }
    BackendInfo info() const override
    {
        return {.title = "Vulkan",
                .distribution =
                    "one invocation per pixel, workgroups of 8 x 8 pixels, in passes short enough for "
                    "watchdogs",
                .has_driver = true,
                .band = true,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }

    // Reads the manifests of drivers in the folders in which the Vulkan loader searches.
    std::vector<InstalledDriver> installed_drivers() const override
    {
        std::vector<InstalledDriver> found;
        for (const char* folder : {"/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
            for (const std::string& path : files_in(folder)) {
                std::ifstream file(path);
                const auto manifest = nlohmann::json::parse(file, nullptr, false);
                if (!manifest.is_object() || !manifest.contains("ICD")) continue;
                const auto text = [&](const char* key) {
                    const auto value = manifest["ICD"].find(key);
                    return value != manifest["ICD"].end() && value->is_string() ? value->get<std::string>() : "";
                };
                found.push_back({"vulkan", path, text("library_path"), text("api_version")});
            }
        }
        found.push_back({"loader", "libvulkan.so.1", "libvulkan.so.1", ""});
        return found;
    }

    std::optional<std::string> unavailable() const override
    {
        try {
            const Instance instance;
            return std::nullopt;
        } catch (const Unavailable& reason) {
            return reason.what();
        }
    }

    std::vector<Device> devices() const override
    {
        std::vector<Device> devices;
        try {
            const Instance instance;
            for (const auto& physical : instance.devices()) devices.push_back(facts_of(physical).device);
        } catch (const Error&) {
            devices.clear();  // unavailable() returns the reason
        }
        return devices;
    }

    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        return std::make_unique<VulkanRenderer>(options);
    }

    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        auto session = opened(options);
        double peak = 0;
        guarded(session, [&] {
            peak = attempt(session->gpu.name(), "measuring the multiply-add peak", [&] {
                return options.precision == Precision::f32 ? measured_peak<float>(*session, options.precision)
                                                           : measured_peak<double>(*session, options.precision);
            });
        });
        return peak;
    }
};

}  // namespace
}  // namespace vulkan

std::unique_ptr<Backend> make_vulkan_backend() { return std::make_unique<vulkan::VulkanBackend>(); }

}  // namespace mandelmarch
