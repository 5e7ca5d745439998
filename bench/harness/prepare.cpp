// SPDX-License-Identifier: Apache-2.0
#include "bench/harness/prepare.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"

namespace mandelmarch::bench {
namespace {

// Throws Unavailable if there is not enough memory for three pictures with all layers, as used in verification, and one
// with bytes only, as used in timing.
void check_memory(const Scene& scene)
{
    const std::uint64_t pixels = static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
    const std::uint64_t needed =
        pixels * (3 * Image::bytes_per_pixel(Image::Layers::all) + Image::bytes_per_pixel(Image::Layers::bytes));
    if (const std::uint64_t available = available_memory(); needed > available) {
        throw Unavailable(fmt::format("{} x {} pixels need {} MiB of memory and {} MiB are available", scene.width,
                                      scene.height, needed >> 20, available >> 20));
    }
}

void describe(Row& row, const RenderStats& report)
{
    row.threads = report.threads;
    row.simd_width = report.simd_width;
    row.instruction_set = report.instruction_set;
    row.context = report.timings.context;
    row.build = report.timings.build;
    row.step_factor = report.step_factor;
    row.unsettled = report.unsettled;
    row.work = report.work;
}

// Calls `draw`, which renders the first picture. If it throws, the message is kept as the reason why the configuration
// has no speed.
template <class Draw>
std::optional<TimedCase> prepared(Case& one, const Draw& draw)
{
    Row& row = one.row;
    TimedCase live;
    live.one = &one;
    try {
        check_memory(one.scene);
        draw(live);
        describe(row, live.first);
    } catch (const Unavailable& error) {
        row.unavailable = error.what();
    } catch (const InputError& error) {
        // An option is not supported, for example a pack width on this machine.
        row.unavailable = error.what();
    } catch (const Error& error) {
        row.failure = error.what();
    }
    if (!row.verification.passed || !row.unavailable.empty()) return std::nullopt;
    live.expected = live.first.timings.kernel;
    return live;
}

}  // namespace

std::optional<TimedCase> verified_case(Case& one, ExpectedPictures& pictures)
{
    return prepared(one, [&](TimedCase& live) {
        Row& row = one.row;
        const auto& expected = pictures.for_case(one);
        live.renderer = one.backend->create(one.options);
        if (pictures.renders_expected(one)) {
            live.first = expected.stats;
            row.verification.drawn = row.verification.passed = row.verification.is_expected = true;
            row.verification.text = row.verification.level = "expected picture";
            live.fingerprint = fingerprint(expected.image);
        } else {
            Image image(one.scene.width, one.scene.height, Image::Layers::all);
            live.first = live.renderer->render(one.scene, image);
            verify(row, one.backend->info().role, image, expected);
            live.fingerprint = fingerprint(image);
        }
    });
}

std::optional<TimedCase> unverified_case(Case& one)
{
    return prepared(one, [&](TimedCase& live) {
        live.renderer = one.backend->create(one.options);
        Image image(one.scene.width, one.scene.height, Image::Layers::bytes);
        live.first = live.renderer->render(one.scene, image);
        live.fingerprint = fingerprint(image);
        one.row.verification.passed = true;
    });
}

}  // namespace mandelmarch::bench
