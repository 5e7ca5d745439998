// SPDX-License-Identifier: Apache-2.0
#include "bench/proof.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/render/agreement.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

constexpr std::size_t most_reference_pixels = 1 << 20;

}  // namespace

Yardsticks::Source Yardsticks::source_for(const Case& one) const
{
    const auto pixels = static_cast<std::size_t>(one.scene.width) * static_cast<std::size_t>(one.scene.height);
    const Backend* reference = registry_.find(Role::reference);
    const bool by_reference = reference != nullptr && reference->draws(one.scene) && pixels <= most_reference_pixels;
    if (one.options.mode == Mode::fast && by_reference) {
        return {reference, {.mode = Mode::fast}, fmt::format("{}, double, fast", reference->name())};
    }
    const Precision precision = one.options.mode == Mode::fast ? Precision::f64 : one.options.precision;
    const Backend& host = registry_.with(Role::host);
    return {&host,
            {.precision = precision, .mode = one.options.mode, .pack = 1},
            fmt::format("{} --pack 1, {}, {}", host.name(), name_of(precision), name_of(one.options.mode))};
}

std::string Yardsticks::key(const Case& one) const
{
    const Scene& s = one.scene;
    const auto triple = [](const Vector& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); };
    return fmt::format(
        "{} {}x{} n{} D{} shape {} escape {} at {} to {} up {} field {} look {} {} conservative {} smooth {} "
        "centred {} part {} {} of {} {} step {} {} {}",
        s.fractal->name, s.width, s.height, s.iterations, s.detail, fmt::join(s.shape, " "), s.escape, triple(s.eye),
        triple(s.target), triple(s.up), s.field_of_view, s.colouring, s.brightness, s.conservative, s.smooth, s.centred,
        s.crop_window.left, s.crop_window.bottom, s.crop_window.whole_width, s.crop_window.whole_height,
        s.limits.step_factor, s.limits.root_share, source_for(one).name);
}

bool Yardsticks::is_yardstick(const Case& one) const
{
    const Source source = source_for(one);
    return one.backend == source.backend && one.options.mode == Mode::fast &&
           one.options.precision == source.options.precision && one.options.pack == source.options.pack;
}

const Yardsticks::Yardstick& Yardsticks::for_case(const Case& one)
{
    Yardstick& kept = one.options.mode == Mode::exact ? exact_ : fast_;
    const std::string wanted = key(one);
    if (kept.key == wanted) return kept;
    const Source source = source_for(one);
    if (source.backend->unavailable()) {
        throw Unavailable(fmt::format("nothing to compare with: backend {} is not here", source.backend->name()));
    }
    kept = {};
    Image image(one.scene.width, one.scene.height, Image::Layers::all);
    RenderStats report = source.backend->create(source.options)->render(one.scene, image);
    kept = {wanted, source.name, std::move(image), std::move(report)};
    return kept;
}

void prove(Row& row, Role role, const Image& image, const Yardsticks::Yardstick& yardstick)
{
    const Agreement found = agreement(yardstick.image, image, row.precision);
    // The reference is a separate implementation: its exact picture is close to the kernel's, not identical.
    const Level required = role == Role::reference ? Level::perceptual : level_required(row.mode);
    Proof& proof = row.proof;
    proof.drawn = true;
    proof.passed = found.level <= required;
    // With `--without root` hits are not refined: the same rays hit, but at slightly different points. Then only the
    // hits are compared: at most one pixel in a thousand may hit instead of miss, or miss instead of hit.
    if (!techniques_without(row.setting.without).root) {
        proof.passed = found.numbers && 1000 * found.comparison.hit_or_miss <= found.comparison.pixels;
    }
    proof.level = name_of(found.level);
    proof.text = summary(found);
    proof.against = yardstick.name;
    proof.pixels = found.comparison.pixels;
    proof.differing = found.comparison.differing;
    proof.visibly_differing = found.comparison.visibly_differing;
    proof.largest_ulps = found.largest_ulps;
    proof.psnr = found.comparison.psnr;
    if (!proof.passed) {
        row.failure =
            fmt::format("the picture is wrong: {} of {} pixels differ from {}, {} of them visibly, {} required",
                        found.comparison.differing, found.comparison.pixels, yardstick.name,
                        found.comparison.visibly_differing, name_of(required));
        if (found.comparison.first >= 0) {
            row.failure += "; " + describe_pixel(yardstick.image, image, found.comparison.first);
        }
    }
}

std::uint64_t fingerprint(const Image& image)
{
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::uint8_t byte : image.bytes()) hash = (hash ^ byte) * 0x100000001b3;
    return hash;
}

}  // namespace mandelmarch::bench
