// SPDX-License-Identifier: Apache-2.0
#include "core/render/expected.h"

#include <fmt/format.h>

namespace mandelmarch {
namespace {

constexpr std::int64_t most_reference_pixels = 1 << 20;

}  // namespace

ExpectedBy expected_by(const Registry& registry, const Scene& scene, Precision precision, Mode mode)
{
    RendererOptions options{.precision = precision, .mode = mode, .simd_width = 1};
    const char* without = "";
    if (mode == Mode::fast) {
        const Backend* reference = registry.find(Role::reference);
        if (reference != nullptr && reference->draws(scene) &&
            std::int64_t{scene.width} * scene.height <= most_reference_pixels) {
            return {reference, {.mode = Mode::fast}, fmt::format("{}, double, fast", reference->name())};
        }
        options.precision = Precision::f64;
        options.techniques.cones = options.techniques.neighbours = false;
        without = " --without cones,neighbours";
    }
    const Backend& host = registry.with(Role::host);
    return {
        &host, options,
        fmt::format("{} --simd-width 1{}, {}, {}", host.name(), without, name_of(options.precision), name_of(mode))};
}

}  // namespace mandelmarch
