// SPDX-License-Identifier: Apache-2.0
#include "backends/vulkan/renderer.h"

#include <fmt/format.h>

#include <algorithm>

#include "backends/vulkan/executor.h"
#include "core/base/cores.h"
#include "core/scene/fractal.h"

namespace mandelmarch::vulkan {
namespace {

// The Vulkan objects of a renderer. They are destroyed in reverse order of their declaration.
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

class VulkanRenderer : public Renderer {
public:
    explicit VulkanRenderer(const RendererOptions& options) : options_(options)
    {
        const auto start = Clock::now();
        try {
            session_ = std::make_unique<Session>(options);
        } catch (const Unavailable& unavailable) {
            const std::string why = unavailable.what();
            throw Unavailable(why.starts_with("backend ") ? why : "backend vulkan: " + why);
        }
        variant_ = fmt::format("{}_{}", name_of(options.precision), name_of(options.mode));
        guarded([&] {
            if (options.mode == Mode::exact) {
                const std::string ending = exact_modules(session_->gpu, session_->bench, options.precision);
                session_->bench = {};
                variant_ += ending;
                instruction_set_ = ending == "_corrected" ? "SPIR-V, float quotients corrected"
                                   : ending == "_pinned"  ? "SPIR-V, float quotients in double"
                                                          : "SPIR-V";
            }
        });
        context_ = seconds_since(start);
    }

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        if (session_ == nullptr) throw Error("backend vulkan: the device did not answer before and was given up");
        RenderStats report;
        guarded([&] {
            report = options_.precision == Precision::f32 ? render_as<float>(scene, image, progress)
                                                          : render_as<double>(scene, image, progress);
        });
        return report;
    }

private:
    // Runs f. If the device does not respond, abandons it with all objects that it may still use, because their
    // destruction would block.
    template <class Function>
    void guarded(Function f)
    {
        try {
            f();
        } catch (const DeviceHung&) {
            static_cast<void>(session_.release());
            throw;
        } catch (...) {
            session_->gpu.discard();
            throw;
        }
    }

    template <class Real>
    RenderStats render_as(const Scene& scene, Image& image, const Progress& progress)
    {
        const auto start = Clock::now();
        Gpu& gpu = session_->gpu;
        const auto kernel = kernel_scene<KernelScene<Real>>(scene, options_.mode, options_.techniques);
        const Limits limits = limits_of(gpu.info(), sizeof(Real), options_.band);
        const auto pixels =
            static_cast<vk::DeviceSize>(rows_per_band(scene, limits)) * static_cast<vk::DeviceSize>(scene.width);
        RenderStats report{.backend = "vulkan",
                           .device = gpu.info().device,
                           .precision = options_.precision,
                           .mode = options_.mode,
                           // lavapipe does not report its number of threads, but they have names.
                           .threads = gpu.info().counts_loops ? std::max(1, threads_named("llvmpipe-")) : 1,
                           .instruction_set = instruction_set_,
                           .timings = {},
                           .work = {}};
        Timings& timings = report.timings;
        timings.context = context_;
        if (loaded_ != scene.fractal->name) {
            load(scene.fractal->name);
            timings.build = seconds_since(start);
        }

        const auto upload = Clock::now();
        bind_buffers<Real>(pixels);
        gpu.commands().updateBuffer<KernelScene<Real>>(*session_->bench.buffers[scene_buffer].handle, 0, kernel);
        gpu.barrier();
        gpu.finish("uploading the scene");
        timings.upload = seconds_since(upload);

        BandExecutor<Real> executor(gpu, session_->bench, kernel, pixels, bytes_alone(image, options_), timings);
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
        session_->bench.program = std::make_unique<Program>(session_->gpu, module, 5);
        loaded_ = fractal;
    }

    // Binds buffers for bands of `pixels` pixels. Reuses the buffers of earlier pictures if they are large enough.
    template <class Real>
    void bind_buffers(vk::DeviceSize pixels)
    {
        using Bands = BandExecutor<Real>;
        auto& buffers = session_->bench.buffers;
        if (held_ < pixels) {
            const Gpu& gpu = session_->gpu;
            const bool shared = gpu.info().shares_memory;
            const vk::DeviceSize size = Bands::results_size(pixels);
            held_ = 0;
            buffers.clear();
            buffers.push_back(gpu.make_buffer(sizeof(KernelScene<Real>), Place::device, "the scene"));
            buffers.push_back(gpu.make_buffer(ray_size(sizeof(Real)) * pixels, Place::device, "rays"));
            buffers.push_back(gpu.make_buffer(size, shared ? Place::host : Place::device, "pixels"));
            if (!shared) buffers.push_back(gpu.make_buffer(size, Place::host, "the pixels' way back"));
            held_ = pixels;
        }
        const Buffer* results = &buffers[result_buffer];
        session_->bench.program->bind(std::array{
            Binding{&buffers[scene_buffer], 0, VK_WHOLE_SIZE}, Binding{&buffers[ray_buffer], 0, VK_WHOLE_SIZE},
            Binding{results, reals_at, real_planes * sizeof(Real) * pixels},
            Binding{results, Bands::wholes_at(pixels), Bands::wholes_size(pixels)}, Binding{results, 0, flags_size}});
    }

    RendererOptions options_;
    std::unique_ptr<Session> session_;
    std::string variant_;                     // suffix of the modules' names
    std::string instruction_set_ = "SPIR-V";  // for the user; names the method of float divisions, too
    std::string loaded_;                      // name of the fractal whose program is loaded
    vk::DeviceSize held_ = 0;                 // pixels that the Workbench's buffers can hold
    double context_ = 0;                      // seconds
};

}  // namespace

std::unique_ptr<Renderer> make_renderer(const RendererOptions& options)
{
    return std::make_unique<VulkanRenderer>(options);
}

}  // namespace mandelmarch::vulkan
