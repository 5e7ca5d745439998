// SPDX-License-Identifier: Apache-2.0
#include "tests/equivalence/equivalence.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/render/expected.h"
#include "core/scene/fractal.h"

namespace mandelmarch {

std::string equivalence_header()
{
    return fmt::format("{:<10} {:<9} {:<24} {:<7} {:<6} {:>6}  {:<11} {:>20}  {}", "fractal", "backend", "device",
                       "number", "mode", "scenes", "level", "differing pixels", "first differing pixel");
}

std::string to_text(const EquivalenceRow& row)
{
    return fmt::format("{:<10} {:<9} {:<24.24} {:<7} {:<6} {:>6}  {:<11} {:>20}  {}{}", row.fractal, row.backend,
                       row.device, name_of(row.precision), name_of(row.mode), row.scenes, name_of(row.level),
                       fmt::format("{} of {}", row.differing, row.pixels),
                       row.mode == Mode::exact || !row.passed() ? row.first : "", row.passed() ? "" : "  FAILED");
}

const Image& Expected::picture(const NamedScene& scene, Precision precision, Mode mode)
{
    const ExpectedBy by = expected_by(registry_, scene.scene, precision, mode);
    const std::string key = fmt::format("{} {}", scene.name, by.name);
    const auto found = pictures_.find(key);
    if (found != pictures_.end()) return found->second;
    return pictures_.emplace(key, render(*by.backend, scene.scene, by.options)).first->second;
}

std::string Expected::suspicion(const NamedScene& scene, Precision precision, const Backend& backend,
                                const Image& wrong)
{
    const std::string key = fmt::format("{} {}", scene.name, name_of(precision));
    const auto& [name, image] = wrong_.try_emplace(key, backend.name(), wrong).first->second;
    if (name == backend.name() || !compare(image, wrong).same()) return {};
    return fmt::format("; {} has the same picture: suspect openmp's scalar kernel", name);
}

EquivalenceRow check(const Backend& backend, const RendererOptions& options, const std::string& fractal,
                     const std::vector<NamedScene>& scenes, Expected& expected)
{
    EquivalenceRow row{.fractal = fractal,
                       .backend = std::string(backend.name()),
                       .device = {},
                       .precision = options.precision,
                       .mode = options.mode,
                       .first = {}};
    const auto renderer = backend.create(options);
    for (const NamedScene& named : scenes) {
        if (named.scene.fractal->short_name != fractal) continue;
        Image image(named.scene.width, named.scene.height, Image::Layers::all);
        const RenderStats report = renderer->render(named.scene, image);
        row.device = report.device.name;
        const Image& right = expected.picture(named, options.precision, options.mode);
        const Agreement found = agreement(right, image, options.precision);
        const Comparison& c = found.comparison;
        ++row.scenes;
        row.pixels += c.pixels;
        row.differing += options.mode == Mode::fast ? c.visibly_differing
                                                    : std::max({c.differing, c.differing_colours, c.differing_depths});
        row.level = std::max(row.level, found.level);
        row.largest_ulps = std::max(row.largest_ulps, found.largest_ulps);
        if (c.first >= 0 && row.first.empty()) {
            row.first = fmt::format("{}: {}; {}", named.name, describe_pixel(right, image, c.first),
                                    trace_command(named.scene, options, c.first));
            if (options.mode == Mode::exact) row.first += expected.suspicion(named, options.precision, backend, image);
        }
    }
    return row;
}

}  // namespace mandelmarch
