// SPDX-License-Identifier: Apache-2.0
#include "bench/fidelity/equivalence.h"

#include "bench/statistics/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "core/render/agreement.h"
#include "core/render/expected.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/scene/random_scene.h"
#include "core/text/error.h"

namespace mandelmarch::bench {
namespace {

constexpr Precision precisions[] = {Precision::f32, Precision::f64};
constexpr int widest_pack = 64;
constexpr double few_pixels = 12;
constexpr double most_iterations = 2e6;  // approximate DE iterations per scene: less than 0.1 s on one core

struct Drawn {
    Image image;
    Work work;
};

Drawn drawn(Renderer& renderer, const Scene& scene)
{
    Drawn result{Image(scene.width, scene.height, Image::Layers::all), {}};
    result.work = renderer.render(scene, result.image).work;
    return result;
}

// Returns a description of the difference in picture or, in exact mode, in work; empty if the picture agrees.
std::string difference(const Drawn& expected, const Drawn& got, const RendererOptions& options)
{
    const Agreement found = agreement(expected.image, got.image, options.precision);
    if (found.level > level_required(options.mode)) {
        const Comparison& c = found.comparison;
        return fmt::format("{} of {} pixels have other colours, {} another depth, {}; {}", c.differing_colours,
                           c.pixels, c.differing_depths, summary(found),
                           describe_pixel(expected.image, got.image, c.first));
    }
    const auto counts = [](const Work& w) { return fmt::format("{}/{}/{}", w.steps, w.de_calls, w.iterations); };
    const std::string right = counts(expected.work);
    const std::string work = counts(got.work);
    if (work == right || options.mode == Mode::fast) return {};
    return fmt::format("the same picture, but other work counts: {} steps/estimates/iterations, expected {}", work,
                       right);
}

// A tested configuration and its renderer. The renderer is reused from scene to scene; after an error, it is created
// again.
class TestedBackend {
public:
    TestedBackend(const Backend& backend, Tested& subject) : backend_(backend), subject_(subject) {}

    // Renders the scene. Returns a description of the difference from the expected picture, or of the error; empty if
    // the picture is correct or the scene is not supported. `wrong`: the first wrong picture of this scene and
    // precision, and the backend that rendered it.
    std::string draw(const Scene& scene, const Drawn& expected, std::optional<std::pair<std::string, Image>>& wrong)
    {
        try {
            if (renderer_ == nullptr) renderer_ = backend_.create(subject_.options);
            Drawn got = drawn(*renderer_, scene);
            std::string different = difference(expected, got, subject_.options);
            ++subject_.pictures;
            if (different.empty()) return different;
            ++subject_.wrong;
            if (wrong && wrong->first != subject_.backend && compare(wrong->second, got.image).same()) {
                different += fmt::format("; {} has the same picture: suspect the expected one", wrong->first);
            }
            if (!wrong) wrong.emplace(subject_.backend, std::move(got.image));
            return different;
        } catch (const Unavailable& why) {
            if (subject_.unavailable++ == 0) subject_.refusal = why.what();
            return {};
        } catch (const Error& error) {
            renderer_.reset();
            ++subject_.wrong;
            return error.what();
        }
    }

    const Tested& subject() const { return subject_; }

private:
    const Backend& backend_;
    Tested& subject_;
    std::unique_ptr<Renderer> renderer_;
};

// Returns the pack widths that the host's backend supports besides its default and 1.
std::vector<int> pack_widths(const Backend& backend, const Scene& scene, Precision precision)
{
    std::vector<int> widths;
    Image image(scene.width, scene.height, Image::Layers::all);
    const int own = backend.create({.precision = precision})->render(scene, image).simd_width;
    for (int simd_width = 2; simd_width <= widest_pack; ++simd_width) {
        if (simd_width == own) continue;
        try {
            backend.create({.precision = precision, .simd_width = simd_width})->render(scene, image);
            widths.push_back(simd_width);
        } catch (const InputError&) {
            // This width is not supported.
        }
    }
    return widths;
}

std::vector<Tested> subjects_of(const Registry& registry, const EquivalenceOptions& options, const Backend& host,
                                const Scene& any, EquivalenceResult& result)
{
    std::vector<Tested> subjects;
    for (const auto& backend : registry.backends()) {
        // The reference is left out: it is a separate implementation, whose bits differ.
        if (backend->info().role == Role::reference) continue;
        if (!options.backends.empty() && std::ranges::find(options.backends, backend->name()) == options.backends.end())
            continue;
        const Listing listing = listing_of(*backend);
        if (!listing.unavailable.empty()) {
            result.missing.push_back(fmt::format("{}: {}", backend->name(), listing.unavailable));
        }
        if (!listing.failure.empty()) result.failures.push_back(listing.failure);
        const auto& devices = listing.devices;
        for (int device = 0; device < static_cast<int>(devices.size()); ++device) {
            for (const Precision precision : precisions) {
                const auto add = [&](int simd_width) {
                    subjects.push_back({.backend = std::string(backend->name()),
                                        .options = {.device = device,
                                                    .precision = precision,
                                                    .mode = options.mode,
                                                    .simd_width = simd_width},
                                        .device = devices[static_cast<std::size_t>(device)].name});
                };
                add(0);
                if (backend.get() != &host) continue;
                for (const int simd_width : pack_widths(*backend, any, precision)) add(simd_width);
            }
        }
    }
    return subjects;
}

Scene scaled(Scene scene, double factor)
{
    scene.width = std::max(1, static_cast<int>(factor * scene.width));
    scene.height = std::max(1, static_cast<int>(factor * scene.height));
    return scene;
}

// Returns the scene, with fewer pixels if it would be too much work, and with fewer iterations if even one pixel would
// be too much work. To measure the work, renders first a few pixels, then more, with `packs`, which are fast.
Scene affordable(std::span<const std::unique_ptr<Renderer>> packs, const Scene& scene)
{
    const auto pixels = [](const Scene& s) { return static_cast<double>(s.width) * s.height; };
    Scene tried = scaled(scene, std::min(1.0, std::sqrt(few_pixels / pixels(scene))));
    for (;;) {
        double each = 1;  // iterations per pixel
        for (const auto& renderer : packs) {
            each = std::max(each, static_cast<double>(drawn(*renderer, tried).work.iterations) / pixels(tried));
        }
        if (each > most_iterations)
            tried.iterations = std::max(1, static_cast<int>(scene.iterations / each * most_iterations));
        Scene next = scaled(scene, std::min(1.0, std::sqrt(most_iterations / each / pixels(scene))));
        next.iterations = tried.iterations;
        if (pixels(next) <= 1.5 * pixels(tried)) return next;
        tried = next;
    }
}

}  // namespace

std::string Tested::name() const
{
    const std::string simd_width = options.simd_width > 0 ? fmt::format(", SIMD width {}", options.simd_width) : "";
    return fmt::format("{}, device {}{}, in {}", backend, options.device, simd_width, name_of(options.precision));
}

EquivalenceResult compare_backends(const Registry& registry, const EquivalenceOptions& options,
                                   const std::function<void(const Discrepancy&)>& found,
                                   const std::function<void(double)>& progress)
{
    std::vector<const Fractal*> of = options.fractals;
    if (of.empty()) {
        for (const Fractal& fractal : fractals()) of.push_back(&fractal);
    }
    const Backend& host = registry.with(Role::host);
    EquivalenceResult result{
        .options = options, .environment = {}, .subjects = {}, .missing = {}, .failures = {}, .discrepancies = {}};
    Scene any = extreme_scene(*of.front(), options.seed, 0);
    any.width = any.height = 1;
    result.subjects = subjects_of(registry, options, host, any, result);
    if (result.subjects.empty() && !result.failures.empty()) throw Error(result.failures.front());
    if (result.subjects.empty() && !result.missing.empty()) throw Unavailable("backend " + result.missing.front());
    std::vector<TestedBackend> tested;
    for (Tested& subject : result.subjects) tested.emplace_back(*registry.find(subject.backend), subject);
    const auto compare_scene = [&](const std::string& name, const Scene& scene) {
        for (const Precision precision : precisions) {
            const ExpectedBy by = expected_by(registry, scene, precision, options.mode);
            const Drawn expected = drawn(*by.backend->create(by.options), scene);
            std::optional<std::pair<std::string, Image>> wrong;
            for (TestedBackend& one : tested) {
                if (one.subject().options.precision != precision) continue;
                const std::string what = one.draw(scene, expected, wrong);
                if (what.empty()) continue;
                result.discrepancies.push_back({name, to_parameters(scene), one.subject().name(), what});
                found(result.discrepancies.back());
            }
        }
    };
    for (const auto& [name, scene] : options.others) compare_scene(name, scene);
    if (!options.others.empty()) return result;
    std::vector<std::unique_ptr<Renderer>> packs;
    for (const Precision precision : precisions) packs.push_back(host.create({.precision = precision}));
    // All scenes of a fractal are rendered before those of the next one, because devices compile a kernel per fractal.
    int done = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
        const auto count = static_cast<int>(of.size());
        const int scenes = options.scenes / count + (static_cast<int>(i) < options.scenes % count ? 1 : 0);
        for (int number = 0; number < scenes; ++number) {
            compare_scene(fmt::format("{}-{}-{}", of[i]->short_name, options.seed, number),
                          affordable(packs, extreme_scene(*of[i], options.seed, number)));
            progress(static_cast<double>(++done) / options.scenes);
        }
    }
    return result;
}

std::string to_console(const EquivalenceResult& result)
{
    Table table({"<backend", ">dev", "<device", "<precision", ">SIMD", ">pictures", ">unavailable", ">wrong"});
    for (const Tested& s : result.subjects) {
        table.add(s.backend, s.options.device, clipped(s.device, 32), name_of(s.options.precision),
                  s.options.simd_width > 0 ? std::to_string(s.options.simd_width) : "", s.pictures, s.unavailable,
                  s.wrong);
    }
    std::string text = table.text();
    for (const Tested& s : result.subjects) {
        if (s.unavailable > 0) text += fmt::format("{}: unavailable, the first: {}\n", s.name(), s.refusal);
    }
    for (const std::string& why : result.missing) text += why + "\n";
    for (const std::string& why : result.failures) text += "FAILED: " + why + "\n";
    return text;
}

}  // namespace mandelmarch::bench
