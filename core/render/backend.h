// SPDX-License-Identifier: Apache-2.0
// The interface of backends. A backend depends on core only. Programs use backends through this header and the
// registry:
//     const auto renderer = registry.with(Role::host).create({.mode = Mode::fast});
//     Image image(scene.width, scene.height, Image::Layers::bytes);
//     const RenderStats stats = renderer->render(scene, image);
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/image/image.h"
#include "core/scene/scene.h"

namespace mandelmarch {

enum class Precision { f64, f32 };  // double, float
enum class Mode { exact, fast };

std::string_view name_of(Precision precision);  // "double", "float"
std::string_view name_of(Mode mode);            // "exact", "fast"

template <class Real>
inline constexpr Precision precision_of = std::is_same_v<Real, float> ? Precision::f32 : Precision::f64;

// Returns the name of generated code, such as "mandelbox_float_exact" (cmake/Kernels.cmake).
std::string variant_name(std::string_view fractal, Precision precision, Mode mode);

struct Device {
    std::string name;
    std::string vendor;
    std::string driver;  // name and version of the driver
    bool is_gpu = false;
};

// Optimisations. Each can be disabled by name, for ablation studies. None changes any bit of a picture in exact mode.
struct Techniques {
    bool hull = true;              // rays end, and in fast mode begin, at a bounding volume of the surface
    bool relaxation = true;        // fast: steps longer than the estimate, and short steps close to a hit
    bool cones = true;             // fast: a cone around the rays of a tile finds where they can begin
    bool neighbours = true;        // fast, CPUs: rays begin near the hits of surrounding pixels
    bool trial = true;             // fast: a small trial render decides whether steps must be shorter
    bool refinement = true;        // fast: hits are refined to the canonical root; false: by one secant only
    bool shared_occlusion = true;  // fast, openmp, films: adjacent pixels of one surface share the occlusion of a look
    bool tail = true;              // fast, Mandelbox: the last iterations of an orbit skip most tests
    bool gradient = true;          // fast, double: normals from the gradient; false: from differences of six estimates
};

// Returns all techniques except those in `names`, such as "hull,cones". Throws InputError, which lists the known names.
Techniques techniques_without(std::string_view names);
// Returns the names of the disabled techniques: "hull,cones".
std::string disabled(const Techniques& techniques);

// Options of Backend::create().
struct RendererOptions {
    int device = 0;  // index into Backend::devices()
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    int threads = 0;         // for backends on the host's cores; 0: usable_threads() (core/os/cores.h)
    int simd_width = 0;      // pixels computed at once on a core; 0: the backend's choice
    int chunk = 0;           // tiles that a host thread takes at a time, only for openmp; 0: the backend's choice
    int band = 0;            // max pixels per pass of a device; 0: the backend's choice
    int block_size = 0;      // work items per work group, a multiple of 32; 0: default
    int resident_warps = 0;  // warps of a GPU's multiprocessor that render at once; 0: the backend's choice
    bool counts = true;      // false: RenderStats::work is not needed; openmp then renders fast pictures faster
    Techniques techniques = {};
};

// Times in seconds. `build`, `upload`, `host` and `readback` are separate parts of `wall`, measured by the host's
// clock. The rest of `wall` is overhead of the schedule.
struct Timings {
    double context = 0;   // finding and opening the device, in create(); not a part of `wall`
    double build = 0;     // preparing the kernel, in the first picture of a fractal; 0 in later pictures
    double upload = 0;    // allocating device memory and copying the scene to it; 0 on the host
    double kernel = 0;    // kernels, by the device's clock; the same as `host` on the host or without such a clock
    double trial = 0;     // the part of `kernel` before the picture's own kernels, in which a trial was rendered
    double host = 0;      // launching kernels and waiting for them
    double readback = 0;  // from the last kernel until the picture is in host memory: copying, converting, counting
    double wall = 0;      // the whole call of render()

    // Adds the time of a kernel, measured by the host's clock and by the device's, if it has one.
    void ran(double by_host, std::optional<double> by_device = {})
    {
        kernel += by_device.value_or(by_host);
        host += by_host;
    }
};

// The work for one picture, counted by the kernel itself. All counts are 0 if it does not count.
struct Work {
    std::uint64_t steps = 0;       // number of samples taken by marching
    std::uint64_t de_calls = 0;    // number of DE evaluations, including those of refinement and normals
    std::uint64_t iterations = 0;  // number of iterations of these DE evaluations
};

// Adds all times except `context`, which a renderer spends only once.
Timings& operator+=(Timings& to, const Timings& from);
Work& operator+=(Work& to, const Work& from);

// Adds the work counts of width x height pixels.
template <class Real>
void add_work(Work& work, const Planes<Real>& planes, int width, int height);

// Adds the work of cones: for each cone its DE evaluations, then its iterations.
void add_cone_work(Work& work, std::span<const int> cones);

// The resources that a thread of a kernel needs, as compiled by the driver.
struct KernelResources {
    std::string kernel;
    int registers = 0;
    int local_bytes = 0;  // private memory: the stack, including spilled registers
};

// Statistics of a rendered picture: configuration, times and work.
struct RenderStats {
    std::string backend;
    Device device;
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    int threads = 1;
    int simd_width = 1;
    std::string instruction_set;  // or the device's architecture; may be empty
    // Results of a trial (core/render/trial.h); both are 0 without a trial. step_factor: the selected step factor.
    // unsettled: the fraction of the trial's pixels that shorter steps would still change visibly; 0 if it is small.
    double step_factor = 0;
    double unsettled = 0;
    Timings timings;
    Work work;
    std::vector<KernelResources> kernels = {};  // empty if the driver does not report them
};

// Progress callback and stop token of render(). In the thread that called render(), the callback receives the fraction
// of the picture that is finished, from 0 to 1. Any thread may request a stop. render() then throws Cancelled, at the
// latest before its next band, and the contents of the image are undefined.
class Progress {
public:
    Progress() = default;
    template <class Told>
    requires std::is_invocable_v<Told&, double> Progress(
        Told told, std::stop_token stop = {})  // NOLINT(google-explicit-constructor): a function is a Progress
        : told_(std::move(told)), stop_(std::move(stop))
    {
    }
    explicit Progress(std::stop_token stop) : stop_(std::move(stop)) {}

    explicit operator bool() const { return told_ || stop_.stop_possible(); }
    // Returns true after a stop request. May be called from any thread.
    bool cancelled() const { return stop_.stop_requested(); }
    // Calls the callback. Throws Cancelled after a stop request.
    void operator()(double share) const;

private:
    std::function<void(double)> told_;
    std::stop_token stop_;
};

class Renderer {
public:
    virtual ~Renderer() = default;

    // A small picture of bytes, of a trial.
    struct SmallPicture {
        Scene scene;
        Image image;
    };

    // Renders `scene` into `image` and overwrites all of it. The image must have the scene's width, and all rows of the
    // scene or only some of them, beginning with Image::first_row(). In exact mode, rows do not depend on which others
    // are rendered; for fast mode see core/render/region.h. May be called repeatedly. Throws Unavailable if the scene's
    // fractal is not supported, Error if the device fails, and Cancelled.
    virtual RenderStats render(const Scene& scene, Image& image, const Progress& progress = {}) = 0;

    // Like render(), but renders up to two small pictures at the same time. Renders nothing and returns nothing if this
    // would take longer than the picture alone.
    virtual std::optional<RenderStats> render_beside(std::span<SmallPicture>, const Scene&, Image&, const Progress&)
    {
        return std::nullopt;
    }

    // Locks the memory of the bytes of many pictures, so that the device copies to it at full speed. Returns the lock,
    // which must be destroyed before the memory is freed, in the same thread; null if there is none, which costs time
    // only.
    virtual std::shared_ptr<void> lock_memory(std::span<std::uint8_t>) { return nullptr; }
};

// The role of a backend. Programs that need a certain backend select it by its role.
enum class Role {
    none,
    reference,   // shares no formulas with the kernel; gives expected pictures and baseline times, without a trial
    host,        // the kernel on this machine's cores; with SIMD width 1 it defines the exact bits for all backends
    accelerator  // selected by `--backend auto` if it has a GPU
};

std::string_view name_of(Role role);  // "reference", "host", "accelerator", or "" for none

// Compiler and flags of a backend's kernels. mandelmarch_kernel_build() (cmake/Backend.cmake) sets them in the
// backend's CMakeLists.txt.
struct KernelBuild {
    std::string compiler = {};
    std::string exact = {};  // compiler flags in exact mode
    std::string fast = {};   // compiler flags in fast mode
};

// Properties of a backend that do not depend on the machine.
struct BackendInfo {
    std::string_view title = {};         // the model's name as its authors spell it, for people
    std::string_view distribution = {};  // how it distributes the work, in a phrase for the report
    Role role = Role::none;
    bool has_driver = false;  // uses a driver of a third party, which may crash; programs run it in a separate process
    // The following members are true if the backend uses the member of RendererOptions with the same name.
    bool threads = false;
    bool simd_width = false;
    bool chunk = false;
    bool band = false;
    bool block_size = false;
    bool resident_warps = false;
    bool concurrent = false;  // renderers with one thread each can render at the same time, on threads of the caller
    // Its pictures are bytes alone, the same in each precision and mode, and it has no techniques.
    bool foreign = false;
    bool replays = false;           // it may keep a picture from an earlier call
    std::string_view gpus = "GPU";  // the kind of GPU that an accelerator needs, for messages
    // If not empty, the backend only makes others: "NAME:argument" names one. This is what `argument` stands for.
    std::string_view argument = {};
    KernelBuild build = {};
};

// An installed driver, or the loader that opens drivers, as files of the system describe it.
struct InstalledDriver {
    std::string api;          // name of the API; "loader" for the loader
    std::string file;         // the file that names the driver
    std::string library;      // path of the driver's library, or its name for the dynamic linker
    std::string api_version;  // may be empty
};

class Backend {
public:
    virtual ~Backend() = default;

    virtual std::string_view name() const = 0;

    // Returns the backend's properties. Does not access any device.
    virtual BackendInfo info() const { return {}; }

    // Returns the drivers that the API's loader would open. Only reads files, and does not open drivers.
    virtual std::vector<InstalledDriver> installed_drivers() const { return {}; }

    // Returns the reason why no device can be used; nullopt if one can.
    virtual std::optional<std::string> unavailable() const { return std::nullopt; }

    // Returns the devices; empty if unavailable() returns a reason.
    virtual std::vector<Device> devices() const = 0;

    // Returns false if no device can render the scene, for example because its fractal is unknown.
    virtual bool draws(const Scene& scene) const
    {
        static_cast<void>(scene);
        return true;
    }

    // Returns the backend "NAME:argument", if info().argument is not empty. Throws InputError for a wrong argument.
    virtual std::unique_ptr<Backend> with_argument(const std::string& argument) const
    {
        static_cast<void>(argument);
        return nullptr;
    }

    // Returns a renderer. Throws Unavailable if the device does not exist or does not support the options. In fast mode
    // a trial (core/render/trial.h) precedes each picture, unless the backend is a reference or another program.
    std::unique_ptr<Renderer> create(const RendererOptions& options) const;

    // Returns the multiply-add peak (core/kernel/peak.h) of the device and the precision in the options, in operations
    // per second; nullopt if the backend cannot measure it or the device does not support the precision. Takes about a
    // second. Throws Error if the device fails.
    virtual std::optional<double> multiply_add_peak(const RendererOptions& options) const
    {
        static_cast<void>(options);
        return std::nullopt;
    }

private:
    // Like create(), but without a trial, unless runs_trials().
    virtual std::unique_ptr<Renderer> do_create(const RendererOptions& options) const = 0;
    virtual bool runs_trials() const { return false; }
};

}  // namespace mandelmarch
