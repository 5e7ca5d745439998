// SPDX-License-Identifier: Apache-2.0
#include "bench/fidelity/random_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <random>
#include <tuple>

#include "bench/statistics/table.h"
#include "core/render/agreement.h"
#include "core/render/expected.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/scene/random_scene.h"
#include "core/text/error.h"
#include "flight/field/threads.h"

namespace mandelmarch::bench {
namespace {

constexpr int picture_width = 61;  // pixels
constexpr int picture_height = 45;
constexpr std::uint64_t picture_pixels = picture_width * picture_height;
constexpr Precision tested_precisions[] = {Precision::f64, Precision::f32};

struct DrawnScene {
    unsigned set;
    int number;
    Scene scene;
    Image canonical{picture_width, picture_height, Image::Layers::all};
};

// Generates the same scenes as tests/scenes.cpp: in each set, one random number generator serves all fractals, one
// fractal after the other.
std::vector<DrawnScene> scenes_of(const RandomOptions& options)
{
    std::vector<DrawnScene> scenes;
    for (const unsigned set : options.sets) {
        std::mt19937 random(set);
        for (const Fractal* fractal : options.fractals) {
            const Scene like = official_scene(*fractal, picture_width, picture_height);
            for (int i = 0; i < options.scenes; ++i) scenes.push_back({set, i, random_scene(like, i, random)});
        }
    }
    std::ranges::stable_sort(scenes, {}, [](const DrawnScene& one) { return one.scene.fractal->list_order; });
    return scenes;
}

// Creates the renderer of canonical pictures, on one thread.
std::unique_ptr<Renderer> canonical_renderer(const Registry& registry, const Scene& scene)
{
    ExpectedBy by = expected_by(registry, scene, Precision::f64, Mode::fast);
    by.options.threads = 1;
    return by.backend->create(by.options);
}

// Renders the canonical pictures: as many scenes at the same time as there are cores, each on one thread.
void draw_canonical(const Registry& registry, std::vector<DrawnScene>& scenes,
                    const std::function<void(double)>& progress)
{
    std::mutex guard;
    std::size_t done = 0;
    parallel(scenes.size(), 1, 0, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            canonical_renderer(registry, scenes[i].scene)->render(scenes[i].scene, scenes[i].canonical);
            const std::scoped_lock lock(guard);
            progress(static_cast<double>(++done) / static_cast<double>(scenes.size()));
        }
    });
}

double share(std::uint64_t part, std::uint64_t whole)
{
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::vector<RandomSums> sums_of(const std::vector<RandomRow>& rows, std::uint64_t pixels)
{
    std::vector<RandomSums> all;
    for (const RandomRow& row : rows) {
        auto found = std::ranges::find_if(
            all, [&](const RandomSums& one) { return one.fractal == row.fractal && one.precision == row.precision; });
        if (found == all.end()) {
            all.push_back({.fractal = row.fractal, .precision = row.precision, .all = {}, .sets = {}});
            found = all.end() - 1;
        }
        found->all.add(row, pixels);
        found->sets[std::to_string(row.set)].add(row, pixels);
    }
    std::ranges::stable_sort(all, {}, [](const RandomSums& one) { return fractal_named(one.fractal).list_order; });
    return all;
}

// Returns the row of a scene whose picture differs from the canonical picture by `off`.
RandomRow row_of(const DrawnScene& one, const Scene& scene, Precision precision, const Comparison& off)
{
    return {.fractal = std::string(scene.fractal->short_name),
            .precision = precision,
            .set = one.set,
            .number = one.number,
            .off = off.visibly_differing,
            .hit_or_miss = off.hit_or_miss,
            .scene = scene};
}

// Returns RandomSums::missed. `drawn` renders a scene.
template <class Drawn>
std::string missed(const RandomSums& sums, const std::vector<DrawnScene>& scenes, const Drawn& drawn)
{
    const std::string name = fmt::format("{} {}", sums.fractal, name_of(sums.precision));
    std::string text;
    for (const auto& [seed, set] : sums.sets) {
        if (set.passed()) continue;
        text += fmt::format(
            "{}, set {}: {:.2f} % off (limit {:.0f} %), {:.3f} % hit or miss wrong (limit {:.2f} %); worst: {}\n", name,
            seed, 100 * set.off(), 100 * most_off, 100 * set.wrong_hits(), 100 * most_wrong_hits,
            render_command(set.worst_scene, {.precision = sums.precision, .mode = Mode::fast}));
    }
    if (text.empty()) return text;
    for (const double step_factor : {0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1}) {
        RandomSums tried;
        for (const DrawnScene& one : scenes) {
            if (one.scene.fractal->short_name != sums.fractal) continue;
            Scene scene = one.scene;
            scene.limits.step_factor = step_factor;
            const Comparison off = compare(one.canonical, drawn(scene, sums.precision, Mode::fast));
            tried.sets[std::to_string(one.set)].add(row_of(one, scene, sums.precision, off), picture_pixels);
        }
        if (std::ranges::all_of(tried.sets, [](const auto& set) { return set.second.passed(); })) {
            return text + fmt::format("{}: a step factor of {} holds the limits\n", name, step_factor);
        }
    }
    return text + name + ": no step factor from 0.8 to 0.1 holds the limits\n";
}

}  // namespace

void RandomSum::add(const RandomRow& row, std::uint64_t pixels_of_row)
{
    pixels += pixels_of_row;
    visibly_differing += row.off;
    hit_or_miss += row.hit_or_miss;
    const double part = share(row.off, pixels_of_row);
    worst = std::max(worst, part);
    const double load = std::max(part / most_off, share(row.hit_or_miss, pixels_of_row) / most_wrong_hits);
    if (load >= worst_load) std::tie(worst_load, worst_scene) = std::tie(load, row.scene);
    if (part > most_off) {
        ++far_off;
        if (row.exact_off_percent > 100 * most_off) ++short_of_digits;
    }
    ++scenes;
}

double RandomSum::off() const { return share(visibly_differing, pixels); }
double RandomSum::wrong_hits() const { return share(hit_or_miss, pixels); }

bool RandomSum::passed() const { return off() <= most_off && wrong_hits() <= most_wrong_hits; }

RandomResult summed(RandomResult result)
{
    result.sums =
        sums_of(result.rows, static_cast<std::uint64_t>(result.width) * static_cast<std::uint64_t>(result.height));
    return result;
}

bool RandomResult::passed() const { return std::ranges::all_of(sums, &std::string::empty, &RandomSums::missed); }

RandomResult measure_random(const Registry& registry, const RandomOptions& options,
                            const std::function<void(double)>& progress)
{
    const Backend* backend = options.backend.empty() ? &registry.with(Role::host) : registry.find(options.backend);
    if (backend == nullptr) {
        throw InputError(fmt::format("--backend: '{}' given, expected the name of a backend", options.backend));
    }
    if (const auto why = backend->unavailable()) {
        throw Unavailable(fmt::format("backend {}: {}", backend->name(), *why));
    }
    const Techniques techniques = techniques_without(options.without);
    RandomResult result{.backend = std::string(backend->name()),
                        .without = options.without,
                        .width = picture_width,
                        .height = picture_height,
                        .environment = {},
                        .rows = {},
                        .sums = {}};
    std::vector<DrawnScene> scenes = scenes_of(options);
    draw_canonical(registry, scenes, progress);
    std::unique_ptr<Renderer> renderers[2][2];
    for (const Precision precision : tested_precisions) {
        for (const Mode mode : {Mode::exact, Mode::fast}) {
            renderers[precision == Precision::f32][mode == Mode::fast] =
                backend->create({.precision = precision, .mode = mode, .techniques = techniques});
        }
    }
    const auto drawn = [&](const Scene& scene, Precision precision, Mode mode) {
        Image image(picture_width, picture_height, Image::Layers::all);
        renderers[precision == Precision::f32][mode == Mode::fast]->render(scene, image);
        return image;
    };
    for (const Precision precision : tested_precisions) {
        for (const DrawnScene& one : scenes) {
            const Comparison off = compare(one.canonical, drawn(one.scene, precision, Mode::fast));
            RandomRow& row = result.rows.emplace_back(row_of(one, one.scene, precision, off));
            if (precision == Precision::f32 && share(off.visibly_differing, off.pixels) > most_off) {
                const Comparison exact = compare(drawn(one.scene, Precision::f64, Mode::exact),
                                                 drawn(one.scene, Precision::f32, Mode::exact));
                row.exact_off_percent = 100 * share(exact.visibly_differing, exact.pixels);
            }
        }
    }
    result = summed(std::move(result));
    for (RandomSums& sums : result.sums) sums.missed = missed(sums, scenes, drawn);
    return result;
}

std::string to_console(const RandomResult& result)
{
    const std::vector<RandomSums>& all = result.sums;
    const int sets = static_cast<int>(all.front().sets.size());
    std::string text = fmt::format(
        "Fast mode by {}{} against canonical pictures: {} random scenes a fractal in each of {} sets, "
        "{} x {} pixels\n",
        result.backend, result.without.empty() ? "" : " without " + result.without, all.front().all.scenes / sets, sets,
        result.width, result.height);
    Table table({"<fractal", "<precision", ">pixels off, by set", ">hit or miss wrong",
                 fmt::format(">scenes over {:.0f} %", 100 * most_off), ">short of digits", ">worst"});
    for (const RandomSums& sums : all) {
        const auto range = [&](double (RandomSum::*share)() const, int digits) {
            std::vector<double> values;
            for (const auto& [seed, set] : sums.sets) values.push_back(100 * (set.*share)());
            const auto [min, max] = std::ranges::minmax(values);
            return fmt::format("{:.{}f} to {:.{}f} %", min, digits, max, digits);
        };
        table.add(sums.fractal, name_of(sums.precision), range(&RandomSum::off, 2), range(&RandomSum::wrong_hits, 3),
                  fmt::format("{} of {}", sums.all.far_off, sums.all.scenes), sums.all.short_of_digits,
                  fmt::format("{:.1f}%", 100 * sums.all.worst));
    }
    text += table.text();
    for (const RandomSums& sums : result.sums) text += sums.missed;
    return text + fmt::format(
                      "off: by more than 2 of 255; short of digits: those of the scenes over {0:.0f} % in which exact "
                      "mode's float\npicture, too, is over {0:.0f} % off its double picture; limits of every set, "
                      "{0:.0f} % and {1:.2f} %: {2}\n",
                      100 * most_off, 100 * most_wrong_hits, result.passed() ? "held" : "NOT HELD");
}

}  // namespace mandelmarch::bench
