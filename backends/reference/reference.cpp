// SPDX-License-Identifier: Apache-2.0
// The reference backend: a simple serial renderer in double precision. It shares no formula with the kernel; for
// example, its Mandelbulb uses trigonometric functions. It provides the expected pictures and the baseline times.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "backends/reference/estimators.h"
#include "core/os/cpu.h"
#include "core/os/stopwatch.h"
#include "core/render/backend.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr double far_end = 1000;  // largest t, the distance of a sample from the eye
constexpr int most_steps = 8000;
constexpr double step_factor = 0.95;  // step length as a fraction of the estimate
// Step factor with which the canonical hit is found. It is small, because the Mandelbulb's estimate can be five times
// too large.
constexpr double small_stride = 0.15;
constexpr int most_small_steps = 200'000;
// A component of a normal is the difference of the estimates at two points. Half the distance between them is at most
// this fraction of the tolerance. A larger distance would blur the relief of a canonical picture, whose details are
// about as large as the tolerance or smaller.
constexpr double difference_share = 1e-3;

struct Axes {
    Vector forward, right, up;
    double tangent;  // tangent of half the vertical angle of view
    double aspect;
    int width, height;  // of the whole picture, in pixels
};

Axes axes_of(const Scene& scene)
{
    Axes axes{};
    axes.forward = unit(scene.target - scene.eye);
    axes.right = unit(cross(axes.forward, unit(scene.up)));
    axes.up = cross(axes.right, axes.forward);
    axes.tangent = std::tan(scene.field_of_view * 65 / 2 * std::numbers::pi / 180);
    axes.width = scene.crop_window.whole_width > 0 ? scene.crop_window.whole_width : scene.width;
    axes.height = scene.crop_window.whole_height > 0 ? scene.crop_window.whole_height : scene.height;
    axes.aspect = static_cast<double>(axes.width) / axes.height;
    return axes;
}

Vector direction_through(const Scene& scene, const Axes& axes, int i, int j)
{
    const double within = scene.centred ? 0.5 : 0;  // offset inside the pixel
    const double u = 2 * (scene.crop_window.left + i + within) / axes.width - 1;
    const double v = 2 * (scene.crop_window.bottom + j + within) / axes.height - 1;
    if (scene.projection == Projection::equirectangular) {
        const double longitude = std::numbers::pi * u;
        const double latitude = std::numbers::pi / 2 * v;
        return std::cos(latitude) * (std::cos(longitude) * axes.forward + std::sin(longitude) * axes.right) +
               std::sin(latitude) * axes.up;
    }
    return unit((u * axes.aspect * axes.tangent) * axes.right + (v * axes.tangent) * axes.up + axes.forward);
}

struct Hit {
    bool found = false;
    double t = 0;          // of the hit point
    double tolerance = 0;  // at the hit
};

template <class Fractal>
class Tracer {
public:
    Tracer(const Scene& scene, Mode mode)
        : scene_(scene), mode_(mode), fractal_(scene), axes_(axes_of(scene)), eps_(std::pow(10.0, scene.detail))
    {
    }

    const Work& work() const { return work_; }

    void draw(int i, int j, Image& image)
    {
        const Work before = work_;
        const Vector direction = direction_through(scene_, axes_, i, j);
        const Hit hit = mode_ == Mode::exact ? plain_hit(direction) : canonical_hit(direction);
        Vector colour{0.4, 0.4, 0.4};
        if (hit.found) {
            colour = shaded(normal(hit, direction), direction);
        }
        const double reals[] = {colour.x, colour.y, colour.z,
                                hit.found ? hit.t : std::numeric_limits<double>::infinity()};
        const int wholes[] = {static_cast<int>(work_.steps - before.steps),
                              static_cast<int>(work_.de_calls - before.de_calls),
                              static_cast<int>(work_.iterations - before.iterations)};
        image.store(planes_of(reals, wholes, 1, 1), i, j, 1, 1);
    }

private:
    double distance_at(Vector direction, double t)
    {
        ++work_.steps;
        return fractal_(scene_.eye + t * direction, work_);
    }

    // Marches as the original program does, and returns the last sample.
    Hit plain_hit(Vector direction)
    {
        double t = 0;
        double sample = 0;
        double distance = 0;
        int steps = 0;
        do {
            sample = t;
            distance = distance_at(direction, t);
            t += step_factor * distance;
            ++steps;
        } while (distance > t * eps_ && t <= far_end && steps < most_steps);
        return {distance < t * eps_, sample, t * eps_};
    }

    // Returns the first t with DE(t) = eps t. Marches by small steps to a sample with DE(t) < eps t, then bisects until
    // no floating-point number is left between the two ends.
    Hit canonical_hit(Vector direction)
    {
        const auto outside = [&](double t, double distance) { return !(distance < eps_ * t); };
        double low = 0;
        double high = 0;
        double distance = distance_at(direction, high);
        int steps = 1;
        if (distance < 0) return {true, 0, 0};  // the eye is inside the solid
        while (outside(high, distance)) {
            low = high;
            high += small_stride * distance;
            if (!(high <= far_end) || ++steps > most_small_steps) return {};
            distance = distance_at(direction, high);
        }
        for (;;) {
            const double middle = 0.5 * (low + high);
            if (!(middle > low && middle < high)) return {true, high, high * eps_};
            (outside(middle, distance_at(direction, middle)) ? low : high) = middle;
        }
    }

    // Returns the normal, by central differences one tolerance in front of the hit. If the eye of a canonical picture
    // is inside the solid, there is no surface; the direction towards the eye then serves as the normal.
    Vector normal(const Hit& hit, Vector direction)
    {
        if (mode_ == Mode::fast && hit.t == 0) return -1 * direction;
        const Vector p = scene_.eye + hit.t * direction - hit.tolerance * direction;
        if (scene_.smooth || (scene_.conservative && mode_ == Mode::fast)) return smooth_normal(p, hit.tolerance);
        double h = std::max(length(p), 1.0) * std::sqrt(std::numeric_limits<double>::epsilon());
        if (mode_ == Mode::fast) h = std::min(h, difference_share * hit.tolerance);
        const auto slope = [&](Vector step) { return fractal_(p + step, work_) - fractal_(p - step, work_); };
        return unit({slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h})});
    }

    // Returns the normal at p, computed from the estimates at the four corners of a tetrahedron, each at distance h
    // from p.
    Vector smooth_normal(Vector p, double h)
    {
        Vector sum{};
        for (const Vector corner : {Vector{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}) {
            const Vector towards = unit(corner);
            sum = sum + fractal_(p + h * towards, work_) * towards;
        }
        return unit(sum);
    }

    Vector shaded(Vector n, Vector direction) const
    {
        const double light = 1.8 * std::max(0.3, dot(n - Vector{1, 1, 1}, direction));
        const auto channel = [&](double component) {
            const double c = (light * component + 1) / 2 * scene_.brightness;
            if (std::isnan(c)) return 0.0;
            const double cut = std::clamp(c, 0.0, 1.0);
            return cut * cut;
        };
        const Vector colour{channel(n.x), channel(n.y), channel(n.z)};
        return scene_.colouring == 1 ? Vector{colour.z, colour.y, colour.x} : colour;
    }

    const Scene& scene_;
    Mode mode_;
    Fractal fractal_;
    Axes axes_;
    double eps_;
    Work work_;
};

Device this_cpu() { return {.name = cpu_name(), .vendor = cpu_vendor(), .driver = "serial C++", .is_gpu = false}; }

class ReferenceRenderer : public Renderer {
public:
    explicit ReferenceRenderer(Mode mode) : mode_(mode) {}

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        if (scene.colouring > 1 || look_of(scene) != nullptr) {
            throw Unavailable("backend reference: it draws the colouring types 0 and 1, and no looks");
        }
        const Estimator* estimator = estimator_of(*scene.fractal);
        if (estimator == nullptr) {
            throw Unavailable(fmt::format("backend reference: it does not draw the {}", scene.fractal->name));
        }
        return (this->*estimator->draw)(scene, image, progress);
    }

    static bool knows(const mandelmarch::Fractal& fractal) { return estimator_of(fractal) != nullptr; }

private:
    // The fractals of estimators.h, and the functions that render them.
    struct Estimator {
        std::string_view fractal;
        RenderStats (ReferenceRenderer::*draw)(const Scene&, Image&, const Progress&) const;
    };
    static const Estimator* estimator_of(const mandelmarch::Fractal& fractal)
    {
        static constexpr Estimator all[] = {{"mandelbulb", &ReferenceRenderer::draw<reference::Mandelbulb>},
                                            {"mandelbox", &ReferenceRenderer::draw<reference::Mandelbox>}};
        const auto* found = std::ranges::find(all, fractal.name, &Estimator::fractal);
        return found == std::end(all) ? nullptr : found;
    }

    template <class Fractal>
    RenderStats draw(const Scene& scene, Image& image, const Progress& progress) const
    {
        const auto start = Clock::now();
        Tracer<Fractal> tracer(scene, mode_);
        for (int j = image.first_row(); j < image.end_row(); ++j) {
            for (int i = 0; i < scene.width; ++i) tracer.draw(i, j, image);
            if (progress) progress(static_cast<double>(j + 1 - image.first_row()) / image.height());
        }
        RenderStats report{.backend = "reference",
                           .device = this_cpu(),
                           .precision = Precision::f64,
                           .mode = mode_,
                           .threads = 1,
                           .simd_width = 1,
                           .instruction_set = "baseline",
                           .timings = {},
                           .work = tracer.work()};
        report.timings.wall = seconds_since(start);
        report.timings.ran(report.timings.wall);
        return report;
    }

    Mode mode_;
};

class ReferenceBackend : public Backend {
public:
    std::string_view name() const override { return "reference"; }
    BackendInfo info() const override
    {
        return {.title = "serial reference",
                .distribution = "one thread, pixel after pixel",
                .role = Role::reference,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    std::vector<Device> devices() const override { return {this_cpu()}; }
    bool draws(const Scene& scene) const override
    {
        return scene.colouring <= 1 && look_of(scene) == nullptr && ReferenceRenderer::knows(*scene.fractal);
    }
    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        if (options.device != 0) {
            throw Unavailable(fmt::format("backend reference: there is no device {}, only device 0", options.device));
        }
        if (options.precision != Precision::f64) throw Unavailable("backend reference: it draws in double only");
        return std::make_unique<ReferenceRenderer>(options.mode);
    }
};

}  // namespace

std::unique_ptr<Backend> make_reference_backend() { return std::make_unique<ReferenceBackend>(); }

}  // namespace mandelmarch
