// SPDX-License-Identifier: Apache-2.0
// The backend interface. A backend knows core/ and nothing of other backends; programs know this page and the registry.
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

// What makes a picture cheaper or (root) better, each to be switched off by its name, so that its worth can be
// measured. None changes a bit of an exact picture.
struct Techniques {
    bool hull = true;          // rays begin (fast) and end where they meet a hull that holds the surface
    bool relaxation = true;    // fast: steps longer than the estimate, and short ones just before a hit
    bool cones = true;         // fast, openmp: cones of 8 x 8 pixels find where their rays begin
    bool neighbours = true;    // fast, openmp: rays begin near the hits of pixels around them
    bool trial = true;         // fast: a small picture shows before whether steps must be shorter
    bool root = true;          // fast: hits are refined to the canonical root, else one secant is all
    bool surroundings = true;  // fast, openmp, films: pixels of one surface share what a look finds around them
    bool tail = true;          // fast, Mandelbox: an orbit's last iterations are made without their tests
    bool normal = true;        // fast, double: normals from the gradient, else from differences of six estimates
};

// All but those named, `hull,cones`, say. Throws InputError with the known names.
Techniques techniques_without(std::string_view names);

// How a renderer is made.
struct RendererOptions {
    int device = 0;  // index into Backend::devices()
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    int threads = 0;     // 0: all that there are; for backends that run on the host's cores
    int pack = 0;        // pixels computed at once on a core; 0: the backend's choice
    int chunk = 0;       // tiles that a host thread takes at once; 0: the backend's choice; for openmp
    int band = 0;        // pixels that a device draws in one go, at most; 0: the backend's choice
    int block = 0;       // threads of a GPU's block, work items of a group: a multiple of 32; 0: the backend's choice
    bool counts = true;  // false: RenderReport::work is not asked for, which makes openmp's fast pictures cheaper
    Techniques techniques = {};
};

// Seconds. `build`, `upload`, `host` and `readback` are parts of `wall`, by the host's clock and apart from each other;
// what they leave is the schedule's own.
struct Timings {
    double context = 0;   // finding and opening the device, in create(); no part of wall
    double build = 0;     // making the kernel ready, in the first picture of a fractal; 0 after that
    double upload = 0;    // memory on the device, and the scene on its way there; 0 on the host
    double kernel = 0;    // the kernels, by the device's own clock; where it tells none, or is the host, as `host`
    double host = 0;      // launching the kernels and waiting for them
    double readback = 0;  // from the last kernel to the picture in host memory: copying, converting, counting
    double wall = 0;      // the whole render() call

    // Kernels took this long by the host's clock, and by the device's if it has one of its own.
    void ran(double by_host, std::optional<double> by_device = {})
    {
        kernel += by_device.value_or(by_host);
        host += by_host;
    }
};

// Work done for one picture, counted by the kernel itself. 0 where it was not asked for and not counted.
struct Work {
    std::uint64_t steps = 0;       // samples taken while marching
    std::uint64_t estimates = 0;   // calls of the distance estimator, all of them
    std::uint64_t iterations = 0;  // of the distance estimator
};

// All but `context`, which a renderer spends once.
Timings& operator+=(Timings& to, const Timings& from);
Work& operator+=(Work& to, const Work& from);

// Adds the counts of width x height pixels.
template <class Real>
void add_work(Work& work, const Planes<Real>& planes, int width, int height);

// What the device's driver made of a kernel, for each thread.
struct KernelResources {
    std::string kernel;
    int registers = 0;
    int local_bytes = 0;  // memory of its own: the stack, with registers that are spilled
};

// What really ran.
struct RenderReport {
    std::string backend;
    Device device;
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    int threads = 1;
    int pack = 1;
    std::string instruction_set;  // or device architecture; may be empty
    // Of a trial (core/render/trial.h): the stride that it chose, in distance estimates, and the share of its pixels
    // that shorter steps would still change visibly, where that is more than a few. 0 and 0 without one.
    double stride = 0;
    double unsettled = 0;
    Timings timings;
    Work work;
    std::vector<KernelResources> kernels = {};  // that drew it; none where the driver does not tell
};

// Called with the finished share of the picture, 0 to 1, from the thread that called render(). Made of any function of
// a share, and of a token by which any thread may cancel the drawing: render() then throws Cancelled, before its next
// band at the latest. What stands in the image is then no picture.
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
    // From any thread.
    bool cancelled() const { return stop_.stop_requested(); }
    // Throws Cancelled.
    void operator()(double share) const;

private:
    std::function<void(double)> told_;
    std::stop_token stop_;
};

class Renderer {
public:
    virtual ~Renderer() = default;

    // Draws `scene` into `image`, which has the scene's width and either all of its rows or some, from
    // Image::first_row() on; the pixels are the same. Writes the whole image. Can be called again.
    // Throws Unavailable if the scene's fractal cannot be drawn, Error if the device fails, Cancelled.
    virtual RenderReport render(const Scene& scene, Image& image, const Progress& progress = {}) = 0;
};

// What a backend is to the programs, which ask for a role where they need one backend.
enum class Role {
    none,
    reference,  // shares no formula with the kernel text: the yardstick of pictures and of speed, drawn without a trial
    host,       // the text on this machine's cores; with pack 1 it draws the exact bits that all others must have
    accelerator  // `auto` takes it where it has a GPU
};

std::string_view name_of(Role role);  // "reference", "host", "accelerator", or "" for none

// How a backend's kernels are compiled. Its CMakeLists.txt says so: mandelmarch_build_facts (cmake/Backend.cmake).
struct BuildFacts {
    std::string compiler = {};
    std::string exact = {};  // flags in each mode
    std::string fast = {};
};

// What is true of a backend on every machine.
struct Facts {
    Role role = Role::none;
    bool has_driver = false;  // code from outside works for it, which may crash: programs run it in its own process
    // Which of RendererOptions' members it heeds.
    bool threads = false;
    bool pack = false;
    bool chunk = false;
    bool band = false;
    bool block = false;
    std::vector<std::string_view> variables = {};  // of the environment, which change how it runs
    BuildFacts build = {};
};

// A driver, or the loader of drivers, as this system's files name it.
struct InstalledDriver {
    std::string api;          // "loader" for the loader
    std::string file;         // that names it
    std::string library;      // by its path, or by a name that the linker finds
    std::string api_version;  // may be empty
};

class Backend {
public:
    virtual ~Backend() = default;

    virtual std::string_view name() const = 0;

    // Asks no device.
    virtual Facts facts() const { return {}; }

    // What its API's loader would open. Reads files, opens no driver.
    virtual std::vector<InstalledDriver> installed_drivers() const { return {}; }

    // Why there is nothing to run on; nullopt if there is.
    virtual std::optional<std::string> unavailable() const = 0;

    // Empty if unavailable.
    virtual std::vector<Device> devices() const = 0;

    // False for scenes that it cannot draw on any device, of a fractal that it does not know, say.
    virtual bool draws(const Scene& scene) const
    {
        static_cast<void>(scene);
        return true;
    }

    // Throws Unavailable if the device is not there or cannot do what is asked.
    virtual std::unique_ptr<Renderer> create(const RendererOptions& options) const = 0;

    // The multiply-add peak, in operations per second, that this backend reaches with core/kernel/peak.h on the device
    // and in the precision of the options; nullopt where the backend has no such kernel or the device no such number.
    // Takes about a second. Throws Error if the device fails.
    virtual std::optional<double> multiply_add_peak(const RendererOptions& options) const
    {
        static_cast<void>(options);
        return std::nullopt;
    }
};

}  // namespace mandelmarch
