// SPDX-License-Identifier: Apache-2.0
// The backend interface. A backend depends on core only; programs use this header and the registry.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
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

struct Device {
    std::string name;
    std::string vendor;
    std::string driver;  // name and version
    bool is_gpu = false;
};

// Optimisations, each of which can be disabled by name for ablation studies. None changes a bit of an exact picture.
struct Techniques {
    bool hull = true;        // rays end, and in fast mode begin, at a bounding volume of the surface
    bool relaxation = true;  // fast: steps longer than the estimate, and short ones close to a hit
    bool cones = true;       // fast, openmp: cones of 8 x 8 pixels find the starting points of rays
    bool neighbours = true;  // fast, openmp: rays begin near the hits of the surrounding pixels
    bool trial = true;       // fast: a small test render decides if steps must be shorter
    bool root = true;        // fast: hits are refined to the canonical root; otherwise by one secant
    bool occlusion = true;   // fast, openmp, films: pixels of one surface share the occlusion of a look
    bool tail = true;        // fast, Mandelbox: the last iterations of an orbit skip their tests
    bool normal = true;      // fast, double: normals from the gradient, otherwise from differences of six estimates
};

// Returns all techniques but those named, such as `hull,cones`. Throws InputError with the known names.
Techniques techniques_without(std::string_view names);

// Options of create().
struct RendererOptions {
    int device = 0;  // index into Backend::devices()
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    int threads = 0;     // 0: usable_threads() (core/base/cores.h); for backends on the host's cores
    int pack = 0;        // pixels computed at once on a core; 0: the backend's choice
    int chunk = 0;       // tiles per request of a host thread; 0: the backend's choice; openmp only
    int band = 0;        // max pixels per pass of a device; 0: the backend's choice
    int block = 0;       // threads per GPU block, or work items per group, a multiple of 32; 0: the backend's choice
    bool counts = true;  // false: RenderStats::work is not needed, which makes openmp's fast pictures cheaper
    Techniques techniques = {};
};

// Seconds. `build`, `upload`, `host` and `readback` are disjoint parts of `wall`, by the host's clock; the rest is
// overhead of the schedule.
struct Timings {
    double context = 0;   // finding and opening the device, in create(); not part of wall
    double build = 0;     // preparing the kernel, in the first picture of a fractal; otherwise 0
    double upload = 0;    // allocating device memory and copying the scene to it; 0 on the host
    double kernel = 0;    // kernels, by the device's clock; without one, or on the host, the same as `host`
    double host = 0;      // launching kernels and waiting for them
    double readback = 0;  // from the last kernel to the picture in host memory: copying, converting, counting
    double wall = 0;      // the whole render() call

    // Adds a kernel's time by the host's clock and, if available, by the device's.
    void ran(double by_host, std::optional<double> by_device = {})
    {
        kernel += by_device.value_or(by_host);
        host += by_host;
    }
};

// Work for one picture, counted by the kernel itself. 0 if it is not counted.
struct Work {
    std::uint64_t steps = 0;       // samples of the marching
    std::uint64_t de_calls = 0;    // all DE evaluations
    std::uint64_t iterations = 0;  // of the DE evaluations
};

// Adds all but `context`, which a renderer spends once.
Timings& operator+=(Timings& to, const Timings& from);
Work& operator+=(Work& to, const Work& from);

// Adds the counts of width x height pixels.
template <class Real>
void add_work(Work& work, const Planes<Real>& planes, int width, int height);

// A kernel's resources per thread, as compiled by the driver.
struct KernelResources {
    std::string kernel;
    int registers = 0;
    int local_bytes = 0;  // private memory: the stack, with spilled registers
};

// Configuration, times and work of a rendered picture.
struct RenderStats {
    std::string backend;
    Device device;
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    int threads = 1;
    int pack = 1;
    std::string instruction_set;  // or device architecture; may be empty
    // From a trial (core/render/trial.h): the chosen step factor, and the fraction of its pixels that shorter steps
    // still change visibly, if more than a few. 0 and 0 without a trial.
    double step_factor = 0;
    double unsettled = 0;
    Timings timings;
    Work work;
    std::vector<KernelResources> kernels = {};  // empty if the driver does not report them
};

// Progress callback and stop token of render(). The callback receives the finished fraction of the picture, 0 to 1, in
// the thread that called render(). Any thread may request a stop: render() then throws Cancelled, at the latest before
// its next band, and the contents of the image are undefined.
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
    // May be called from any thread.
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

    // Renders `scene` into `image` and overwrites all of it. The image has the scene's width and all of its rows or
    // some, from Image::first_row() on; the pixels are the same. May be called repeatedly. Throws Unavailable if the
    // scene's fractal is not supported, Error if the device fails, and Cancelled.
    virtual RenderStats render(const Scene& scene, Image& image, const Progress& progress = {}) = 0;
};

// Role of a backend; programs that need one backend select it by role.
enum class Role {
    none,
    reference,   // independent of the kernel's formulas: renders expected pictures and baseline times, without a trial
    host,        // the kernel on this machine's cores; with SIMD width 1 it defines the exact bits for all backends
    accelerator  // selected by `auto` if it has a GPU
};

std::string_view name_of(Role role);  // "reference", "host", "accelerator", or "" for none

// Compilation of a backend's kernels. Set in its CMakeLists.txt by mandelmarch_kernel_build (cmake/Backend.cmake).
struct KernelBuild {
    std::string compiler = {};
    std::string exact = {};  // compiler flags of each mode
    std::string fast = {};
};

// Properties of a backend that do not depend on the machine.
struct BackendInfo {
    Role role = Role::none;
    bool has_driver = false;  // uses a third-party driver, which may crash: programs run it in a separate process
    // Members of RendererOptions that the backend uses.
    bool threads = false;
    bool pack = false;
    bool chunk = false;
    bool band = false;
    bool block = false;
    std::vector<std::string_view> variables = {};  // environment variables that change its behaviour
    KernelBuild build = {};
};

// An installed driver, or the loader of drivers, as described by the system's files.
struct InstalledDriver {
    std::string api;          // "loader" for the loader
    std::string file;         // file that names the driver
    std::string library;      // path, or a name for the dynamic linker
    std::string api_version;  // may be empty
};

class Backend {
public:
    virtual ~Backend() = default;

    virtual std::string_view name() const = 0;

    // Does not access any device.
    virtual BackendInfo info() const { return {}; }

    // Returns the drivers that the API's loader would open. Reads files; does not open drivers.
    virtual std::vector<InstalledDriver> installed_drivers() const { return {}; }

    // Returns why no device can be used; nullopt: available.
    virtual std::optional<std::string> unavailable() const = 0;

    // Empty if unavailable.
    virtual std::vector<Device> devices() const = 0;

    // False if no device can render the scene, for example for an unknown fractal.
    virtual bool draws(const Scene& scene) const
    {
        static_cast<void>(scene);
        return true;
    }

    // Throws Unavailable if the device does not exist or does not support the options.
    virtual std::unique_ptr<Renderer> create(const RendererOptions& options) const = 0;

    // Returns the multiply-add peak, in operations per second, of core/kernel/peak.h on the device and in the precision
    // of the options; nullopt if the backend has no such kernel or the device does not support the precision. Takes
    // about a second. Throws Error if the device fails.
    virtual std::optional<double> multiply_add_peak(const RendererOptions& options) const
    {
        static_cast<void>(options);
        return std::nullopt;
    }
};

}  // namespace mandelmarch
