// SPDX-License-Identifier: Apache-2.0
#include "backends/opencl/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

#include "backends/opencl/texts.h"
#include "core/base/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"

namespace mandelmarch::opencl {
namespace {

// One device, opened, with the programs it has compiled so far.
struct Session {
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;
    std::map<std::string_view, cl::Program> programs;  // by fractal
    bool is_cpu = false;
    std::int64_t largest_buffer = 0;  // bytes
};

// Waits for an event, at most device_timeout().
void wait_for(cl::Event& event, const char* doing)
{
    struct Signal {
        std::mutex mutex;
        std::condition_variable changed;
        cl_int status = CL_QUEUED;
    };
    // Shared with a callback that may come after this function has given up.
    auto* signal = new std::shared_ptr<Signal>(std::make_shared<Signal>());
    const std::shared_ptr<Signal> mine = *signal;
    event.setCallback(
        CL_COMPLETE,
        [](cl_event, cl_int status, void* data) {
            const std::unique_ptr<std::shared_ptr<Signal>> theirs(static_cast<std::shared_ptr<Signal>*>(data));
            const std::lock_guard lock((*theirs)->mutex);
            (*theirs)->status = status;
            (*theirs)->changed.notify_all();
        },
        signal);
    std::unique_lock lock(mine->mutex);
    const auto limit = std::chrono::duration<double>(device_timeout());
    if (!mine->changed.wait_for(lock, limit, [&] { return mine->status != CL_QUEUED; })) {
        throw DeviceHung(fmt::format("backend opencl: no answer within {} s while {} (MANDELMARCH_DEVICE_TIMEOUT)",
                                     limit.count(), doing));
    }
    if (mine->status < 0) throw cl::Error(mine->status, "the kernel");
}

// Draws bands through one pair of buffers that are as large as the largest band.
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(Session& session, cl::Program& program, const Build& build, const Scene& scene,
                 const RendererOptions& options, std::int64_t pixels, bool bytes_alone)
        : session_(session),
          kernel_(program, "draw_band"),
          lanes_(build.lanes),
          width_(scene.width),
          pixels_(static_cast<std::size_t>(pixels)),
          bytes_alone_(bytes_alone),
          scene_(kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques))
    {
        const Clock::time_point start = Clock::now();
        const cl_mem_flags flags = CL_MEM_READ_WRITE | (session.is_cpu ? CL_MEM_ALLOC_HOST_PTR : 0);
        constants_ = cl::Buffer(session.context, CL_MEM_READ_ONLY, sizeof(scene_));
        // What is not asked for is a buffer of one number: every argument is there.
        const std::size_t planes = bytes_alone ? 1 : pixels_;
        reals_ = cl::Buffer(session.context, flags, real_planes * sizeof(Real) * planes);
        wholes_ = cl::Buffer(session.context, flags, whole_planes * sizeof(int) * planes);
        bytes_ = cl::Buffer(session.context, flags, bytes_alone ? 3 * pixels_ : 1);
        session.queue.enqueueWriteBuffer(constants_, CL_TRUE, 0, sizeof(scene_), &scene_);
        timings.upload = seconds_since(start);
    }

    // Launches the kernel on the largest band without a pixel to draw: some drivers compile at the first launch.
    void warm_up() { launch({0, 0}, static_cast<int>(pixels_) / width_, "compiling"); }

    void run(Entry, const Band& band, int) override
    {
        const Clock::time_point start = Clock::now();
        launch(band, band.rows, "drawing");
        timings.kernel += seconds_since(start);
    }

    bool marching(const Band&) override { return false; }

    void read_back(const Band& band, Image& image) override
    {
        const Clock::time_point start = Clock::now();
        if (bytes_alone_) {
            const std::size_t row = 3 * static_cast<std::size_t>(width_);
            const std::size_t size = row * static_cast<std::size_t>(band.rows);
            std::uint8_t* to = image.bytes().data() + row * static_cast<std::size_t>(band.first_row);
            if (session_.is_cpu) {
                void* bytes = mapped(bytes_, size);
                std::memcpy(to, bytes, size);
                session_.queue.enqueueUnmapMemObject(bytes_, bytes);
            } else {
                session_.queue.enqueueReadBuffer(bytes_, CL_TRUE, 0, size, to);
            }
        } else if (session_.is_cpu) {
            void* reals = mapped(reals_, real_planes * sizeof(Real) * pixels_);
            void* wholes = mapped(wholes_, whole_planes * sizeof(int) * pixels_);
            store(static_cast<const Real*>(reals), static_cast<const int*>(wholes), band, image);
            session_.queue.enqueueUnmapMemObject(reals_, reals);
            session_.queue.enqueueUnmapMemObject(wholes_, wholes);
        } else {
            host_reals_.resize(real_planes * pixels_);
            host_wholes_.resize(whole_planes * pixels_);
            session_.queue.enqueueReadBuffer(reals_, CL_FALSE, 0, sizeof(Real) * host_reals_.size(),
                                             host_reals_.data());
            session_.queue.enqueueReadBuffer(wholes_, CL_TRUE, 0, sizeof(int) * host_wholes_.size(),
                                             host_wholes_.data());
            store(host_reals_.data(), host_wholes_.data(), band, image);
        }
        timings.readback += seconds_since(start);
    }

    Timings timings;
    Work work;

private:
    void launch(const Band& band, int rows_covered, const char* doing)
    {
        // The rectangle of a work item, as in kernel.cl.
        const int wide = lanes_ == 1 ? 1 : lanes_ >= 8 ? 4 : 2;
        const int high = lanes_ / wide;
        // A work group is one tile on a CPU, whose cores take groups in turn, and a square on a GPU.
        const int side_x = session_.is_cpu ? tile_side / wide : 8;
        const int side_y = session_.is_cpu ? tile_side / high : 8;
        const auto groups = [](int pixels, int item, int side) {
            const int count = (pixels + item * side - 1) / (item * side);
            return static_cast<std::size_t>(count) * static_cast<std::size_t>(side);
        };
        kernel_.setArg(0, constants_);
        kernel_.setArg(1, band.first_row);
        kernel_.setArg(2, band.rows);
        kernel_.setArg(3, static_cast<cl_long>(pixels_));
        kernel_.setArg(4, reals_);
        kernel_.setArg(5, wholes_);
        kernel_.setArg(6, bytes_);
        kernel_.setArg(7, bytes_alone_ ? 1 : 0);
        cl::Event done;
        session_.queue.enqueueNDRangeKernel(
            kernel_, cl::NullRange, cl::NDRange(groups(width_, wide, side_x), groups(rows_covered, high, side_y)),
            cl::NDRange(static_cast<std::size_t>(side_x), static_cast<std::size_t>(side_y)), nullptr, &done);
        session_.queue.flush();
        wait_for(done, doing);
    }

    // A CPU's buffers are the host's memory: no copy.
    void* mapped(const cl::Buffer& buffer, std::size_t bytes)
    {
        return session_.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, bytes);
    }

    void store(const Real* reals, const int* wholes, const Band& band, Image& image)
    {
        const auto planes = planes_of(reals, wholes, pixels_, static_cast<std::size_t>(width_));
        image.store(planes, 0, band.first_row, width_, band.rows);
        add_work(work, planes, width_, band.rows);
    }

    Session& session_;
    cl::Kernel kernel_;
    int lanes_;
    int width_;
    std::size_t pixels_;  // that the buffers hold
    bool bytes_alone_;
    KernelScene<Real> scene_;
    cl::Buffer constants_;
    cl::Buffer reals_;
    cl::Buffer wholes_;
    cl::Buffer bytes_;
    std::vector<Real> host_reals_;
    std::vector<int> host_wholes_;
};

class OpenclRenderer : public Renderer {
public:
    OpenclRenderer(const cl::Device& device, const RendererOptions& options)
        : options_(options), build_(build_for(device, options)), session_(std::make_unique<Session>())
    {
        checked("opening the device", [&] {
            const Clock::time_point start = Clock::now();
            session_->device = device;
            session_->context = cl::Context(device);
            session_->queue = cl::CommandQueue(session_->context, device);
            session_->is_cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
            session_->largest_buffer = static_cast<std::int64_t>(
                std::min<cl_ulong>(device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(), std::int64_t{1} << 40));
            context_seconds_ = seconds_since(start);
        });
    }

    RenderReport render(const Scene& scene, Image& image, const Progress& progress) override
    {
        try {
            return checked("drawing", [&] {
                return options_.precision == Precision::f32 ? render_as<float>(scene, image, progress)
                                                            : render_as<double>(scene, image, progress);
            });
        } catch (const DeviceHung&) {
            // Its objects cannot be released while it works: they end with the process.
            static_cast<void>(session_.release());
            throw;
        }
    }

private:
    template <class Real>
    RenderReport render_as(const Scene& scene, Image& image, const Progress& progress)
    {
        const Clock::time_point start = Clock::now();
        const bool first = !session_->programs.contains(scene.fractal->name);
        cl::Program& program = compiled(scene.fractal->name);
        // The planes of a band stand in one buffer.
        const std::int64_t most = session_->largest_buffer / static_cast<std::int64_t>(real_planes * sizeof(Real));
        const std::int64_t rows =
            std::clamp<std::int64_t>(std::min<std::int64_t>(most, usual_band) / scene.width, 1, scene.height);
        const std::int64_t pixels = rows * scene.width;
        // On the heap: a hung device keeps what it works on.
        auto executor = std::make_unique<BandExecutor<Real>>(*session_, program, build_, scene, options_, pixels,
                                                             bytes_alone(image, options_));
        double build_seconds = 0;
        try {
            if (first) {
                executor->warm_up();
                build_seconds = seconds_since(start) - executor->timings.upload;
            }
            run_schedule(scene, options_.mode, {.pixels_per_band = pixels}, *executor, image, progress);
        } catch (const DeviceHung&) {
            static_cast<void>(executor.release());
            throw;
        }
        RenderReport report{.backend = "opencl",
                            .device = description(session_->device),
                            .precision = options_.precision,
                            .mode = options_.mode,
                            .threads = session_->is_cpu ? static_cast<int>(units()) : 1,
                            .pack = build_.lanes,
                            .instruction_set = {},
                            .timings = executor->timings,
                            .work = executor->work};
        report.timings.context = context_seconds_;
        report.timings.build = build_seconds;
        report.timings.wall = seconds_since(start);
        return report;
    }

    cl_uint units() const { return session_->device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>(); }

    cl::Program& compiled(std::string_view fractal)
    {
        if (const auto found = session_->programs.find(fractal); found != session_->programs.end()) {
            return found->second;
        }
        const std::string_view text = text_of(fractal);
        if (text.empty()) throw Unavailable(fmt::format("backend opencl: it does not draw the {}", fractal));
        cl::Program program(session_->context, std::string(text));
        const cl_int code = clBuildProgram(program(), 1, &session_->device(), build_.options.c_str(), nullptr, nullptr);
        if (code == CL_BUILD_PROGRAM_FAILURE) {
            std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(session_->device);
            std::ranges::replace(log, '\n', ' ');
            throw Error(fmt::format("backend opencl: the kernel does not compile: {}", log.substr(0, 500)));
        }
        if (code != CL_SUCCESS) throw cl::Error(code, "clBuildProgram");
        return session_->programs.emplace(fractal, std::move(program)).first->second;
    }

    static constexpr std::int64_t usual_band = 1 << 22;  // pixels

    RendererOptions options_;
    Build build_;
    std::unique_ptr<Session> session_;
    double context_seconds_ = 0;
};

}  // namespace

std::unique_ptr<Renderer> make_renderer(const cl::Device& device, const RendererOptions& options)
{
    return std::make_unique<OpenclRenderer>(device, options);
}

}  // namespace mandelmarch::opencl
