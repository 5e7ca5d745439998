// SPDX-License-Identifier: Apache-2.0
#include "flight/field/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <vector>

#include "core/os/cores.h"
#include "core/scene/parameter_file.h"
#include "core/text/error.h"
#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

constexpr std::size_t many = 256;  // points or rays; computations of more check the budget

static_assert(sizeof(Vector) == 3 * sizeof(double));
field::Triples triples(std::span<const Vector> vectors) { return reinterpret_cast<field::Triples>(vectors.data()); }

// Returns a sphere around the origin that contains the fractal. Rays are cast from far outside towards the origin; the
// radius is the distance of the outermost hit from the origin plus 2 %, but at least 0.1.
Bounds sphere_by_rays(const DistanceField& field)
{
    constexpr int rays = 4000;
    constexpr double far = 20;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Vector> from;
    std::vector<Vector> towards;
    for (int i = 0; i < rays; ++i) {
        const double z = 1 - (2 * i + 1.0) / rays;
        const double rho = std::sqrt(1 - z * z);
        const Vector direction{rho * std::cos(golden * i), rho * std::sin(golden * i), z};
        from.push_back(far * direction);
        towards.push_back(-1 * direction);
    }
    std::vector<double> t(from.size());
    field.casts(from, towards, {.floor = 1e-3, .tolerance = 0, .end = far, .steps = 1000}, t);
    const double nearest = *std::ranges::min_element(t);
    return {Bounds::Shape::sphere, std::max(1.02 * (far - nearest), 0.1)};
}

double processor_seconds()
{
    timespec spent{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &spent);
    return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

}  // namespace

field::Kernel field::kernel_of(std::string_view fractal)
{
    MakeKernel* const make = kernel_maker(fractal);
    if (make == nullptr) throw Unavailable(fmt::format("flight: no distances are built for the fractal {}", fractal));
    return make();
}

Budget::Budget(double seconds, std::string expected)
    : seconds_(seconds), start_(processor_seconds()), expected_(std::move(expected))
{
}

void Budget::check() const
{
    if (processor_seconds() - start_ <= seconds_) return;
    throw InputError(fmt::format("no path within {:.0f} s of processor time, expected {}", seconds_, expected_));
}

DistanceField::DistanceField(const Scene& scene, int threads, const Budget* budget)
    : data_(kernel_scene<layout_f64::Scene>(scene, Mode::exact)),
      scene_(scene),
      kernel_(field::kernel_of(scene.fractal->name)),
      budget_(budget),
      safety_(scene.fractal->flight.trust_of(scene).safety),
      threads_(threads > 0 ? threads : usable_threads())
{
    const std::optional<Bounds> known = scene.fractal->flight.body(scene);
    bounds_ = known ? *known : sphere_by_rays(*this);
}

double DistanceField::distance(Vector p) const
{
    double out = 0;
    distances({&p, 1}, {&out, 1});
    return out;
}

void DistanceField::distances(std::span<const Vector> points, std::span<double> out) const
{
    parallel(points.size(), 4096, threads_, [&](std::size_t first, std::size_t last) {
        for (std::size_t at = first; at < last; at += many) {
            if (budget_ != nullptr && points.size() > many) budget_->check();
            kernel_.distances(data_, triples(points.subspan(at)), std::min(many, last - at), out.data() + at);
        }
    });
}

void DistanceField::casts(std::span<const Vector> from, std::span<const Vector> along, const field::Reach& reach,
                          std::span<double> out) const
{
    parallel(from.size(), 1024, threads_, [&](std::size_t first, std::size_t last) {
        if (budget_ != nullptr && from.size() > many) budget_->check();
        kernel_.casts(data_, triples(from.subspan(first)), triples(along.subspan(first)), reach, last - first,
                      out.data() + first);
    });
}

Vector DistanceField::uphill(Vector p, double h) const
{
    const std::array<Vector, 6> around{Vector{p.x + h, p.y, p.z}, {p.x - h, p.y, p.z}, {p.x, p.y + h, p.z},
                                       {p.x, p.y - h, p.z},       {p.x, p.y, p.z + h}, {p.x, p.y, p.z - h}};
    std::array<double, 6> d{};
    distances(around, d);
    const Vector slope{d[0] - d[1], d[2] - d[3], d[4] - d[5]};
    const double steepness = length(slope);
    return steepness > 0 ? (1 / steepness) * slope : Vector{};
}

double DistanceField::least_between(Vector a, Vector b, double floor) const
{
    const double whole = length(b - a);
    const Vector direction = whole > 0 ? (1 / whole) * (b - a) : Vector{};
    double least = distance(a);
    for (double t = 0, here = least; t < whole && here > floor;) {
        t = std::min(whole, t + safety_ * here);
        here = distance(a + t * direction);
        least = std::min(least, here);
    }
    return least;
}

std::string flight_objection(const Scene& scene)
{
    const Fractal& fractal = *scene.fractal;
    // A fractal's own `body` returns nullopt if the shape is unbounded or has no inside.
    if (fractal.flight.body == defaults::unknown_body || fractal.flight.body(scene)) return {};
    const Scene official = official_scene(fractal);
    for (std::size_t i = 0; i < fractal.shape.size(); ++i) {
        Scene other = scene;
        other.shape[i] = official.shape[i];
        if (!fractal.flight.body(other)) continue;
        const std::string_view name = fractal.shape[i].name;
        return fmt::format("a {} with {} {:.6g} cannot be flown through, expected another {}, {:.6g}, say",
                           fractal.name, name, scene.shape[i], name, official.shape[i]);
    }
    return fmt::format("this {} cannot be flown through, expected another shape", fractal.name);
}

Shapes::Shapes(const Scene& scene, std::size_t number, int threads, const Budget* budget)
    : field_(scene, threads, budget), number_(number)
{
}

Scene Shapes::scene(double value) const
{
    Scene scene = field_.scene();
    scene.shape[number_] = value;
    return scene;
}

const DistanceField& Shapes::at(double value, std::optional<DistanceField>& room) const
{
    if (value == usual()) return field_;
    return room.emplace(scene(value), field_.threads(), field_.budget());
}

void Shapes::distances(std::span<const Vector> points, std::span<const double> values, std::span<double> out) const
{
    if (std::ranges::all_of(values, [this](double value) { return value == usual(); })) {
        field_.distances(points, out);
        return;
    }
    parallel(points.size(), 64, field_.threads(), [&](std::size_t first, std::size_t last) {
        // Consecutive points with the same value share a field.
        for (std::size_t at = first, end = first; at < last; at = end) {
            while (end < last && values[end] == values[at]) ++end;
            std::optional<DistanceField> room;
            this->at(values[at], room).distances(points.subspan(at, end - at), out.subspan(at, end - at));
        }
    });
}

}  // namespace mandelmarch
