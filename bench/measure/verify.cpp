// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/verify.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/os/memory.h"
#include "core/render/agreement.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "core/text/hash.h"

namespace mandelmarch::bench {
namespace {

// Throws Unavailable if there is not enough memory for the three pictures with all layers that verification uses, and
// the one with bytes alone that timing uses.
void check_memory(const Scene& scene)
{
    const std::uint64_t pixels = static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
    const std::uint64_t needed =
        pixels * (3 * Image::bytes_per_pixel(Image::Layers::all) + Image::bytes_per_pixel(Image::Layers::bytes));
    const std::string lack = memory_shortage(fmt::format("{} x {} pixels", scene.width, scene.height), needed);
    if (!lack.empty()) throw Unavailable(lack);
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

// Returns the level of agreement that the configuration's picture needs. A reference and a foreign program are other
// implementations, whose exact pictures are close to the kernel's, but not identical.
Level level_required(const Case& one, const Image& image)
{
    const BackendInfo info = one.backend->info();
    const Level required =
        info.role == Role::reference || info.foreign ? Level::perceptual : level_required(one.row.mode);
    return image.has_values() ? required : std::max(required, Level::same_bytes);
}

}  // namespace

ExpectedBy ExpectedPictures::source_for(const Case& one) const
{
    return expected_by(registry_, one.scene, one.options.precision, one.options.mode);
}

bool ExpectedPictures::renders_expected(const Case& one) const
{
    const ExpectedBy source = source_for(one);
    return one.backend == source.backend && one.options.mode == Mode::fast &&
           one.options.precision == source.options.precision && one.options.simd_width == source.options.simd_width &&
           source.backend->info().role == Role::reference;
}

bool ExpectedPictures::same(const Case& a, const Case& b) const
{
    const ExpectedBy one = source_for(a);
    const ExpectedBy other = source_for(b);
    return a.scene == b.scene && one.backend == other.backend && one.options.precision == other.options.precision &&
           one.options.mode == other.options.mode;
}

const ExpectedPicture& ExpectedPictures::for_case(const Case& one)
{
    ExpectedPicture& kept = one.options.mode == Mode::exact ? exact_ : fast_;
    if (kept.of && same(*kept.of, one)) return kept;
    const ExpectedBy source = source_for(one);
    if (source.backend->unavailable()) {
        throw Unavailable(fmt::format("nothing to compare with: backend {} is unavailable", source.backend->name()));
    }
    kept = {};
    Image image(one.scene.width, one.scene.height, Image::Layers::all);
    RenderStats stats = source.backend->create(source.options)->render(one.scene, image);
    kept = {one, source.name, std::move(image), std::move(stats)};
    return kept;
}

bool passes(const Case& one, const Image& image, const Agreement& found)
{
    // With `--without refinement`, the same rays hit, but at slightly different points. The check then only compares
    // which rays hit, if depths are known: at most one pixel in a thousand may hit instead of miss, or miss instead of
    // hit.
    if (one.options.techniques.refinement) return found.level <= level_required(one, image);
    return found.numbers && 1000 * found.comparison.hit_or_miss <= found.comparison.pixels;
}

std::uint64_t fingerprint(const Image& image) { return fnv1a(image.bytes().data(), image.bytes().size()); }

namespace {

// Sets one.row.verification and, if `image` is wrong, one.row.failure.
void verify(Case& one, const Image& image, const ExpectedPicture& expected)
{
    Row& row = one.row;
    const Agreement found = agreement(expected.image, image, row.precision);
    const Level required = level_required(one, image);
    Verification& verification = row.verification;
    verification.drawn = true;
    verification.passed = passes(one, image, found);
    verification.level = name_of(found.level);
    verification.text = summary(found);
    verification.against = expected.name;
    verification.pixels = found.comparison.pixels;
    verification.differing = found.comparison.differing;
    verification.visibly_differing = found.comparison.visibly_differing;
    verification.max_ulps = found.largest_ulps;
    verification.psnr = found.comparison.psnr;
    if (!verification.passed) {
        row.failure =
            fmt::format("the picture is wrong: {} of {} pixels differ from {}, {} of them visibly, {} required",
                        found.comparison.differing, found.comparison.pixels, expected.name,
                        found.comparison.visibly_differing, name_of(required));
        if (found.comparison.first >= 0) {
            row.failure += "; " + describe_pixel(expected.image, image, found.comparison.first);
        }
    }
}

// Renders the configuration's picture once, verifies it, and passes it to `keep`. Returns nullopt if the configuration
// cannot be timed; one.row then holds the reason.
std::optional<TimedCase> verified_case(Case& one, ExpectedPictures& pictures, const KeepPicture& keep)
{
    Row& row = one.row;
    TimedCase live;
    live.one = &one;
    Image own;
    const Image* image = nullptr;
    try {
        check_memory(one.scene);
        const ExpectedPicture& expected = pictures.for_case(one);
        live.renderer = one.backend->create(one.options);
        if (pictures.renders_expected(one)) {
            live.first = expected.stats;
            row.verification.drawn = row.verification.passed = row.verification.is_expected = true;
            row.verification.text = row.verification.level = "expected picture";
            image = &expected.image;
        } else {
            own = Image(one.scene.width, one.scene.height, Image::Layers::all);
            live.first = live.renderer->render(one.scene, own);
            verify(one, own, expected);
            image = &own;
        }
        live.fingerprint = fingerprint(*image);
        live.expected = live.first.timings.kernel;
        describe(row, live.first);
    } catch (const Unavailable& error) {
        row.unavailable = error.what();
    } catch (const InputError& error) {
        // An option is not supported: for example, this machine lacks a pack width.
        row.unavailable = error.what();
    } catch (const Error& error) {
        row.failure = error.what();
    }
    if (image != nullptr && keep) keep(row, *image);
    if (!row.verification.passed || !row.unavailable.empty()) return std::nullopt;
    return live;
}

}  // namespace

std::vector<TimedCase> verified_cases(std::vector<Case>& cases, const Registry& registry, const Phase& phase,
                                      const KeepPicture& keep)
{
    ExpectedPictures pictures(registry);
    std::vector<TimedCase> live;
    std::vector<Case*> order;
    for (Case& one : cases) {
        if (one.backend != nullptr) order.push_back(&one);
    }
    pictures.group(order, [](Case* one) -> const Case& { return *one; });
    for (std::size_t i = 0; i < order.size(); ++i) {
        phase({"verification", static_cast<double>(i) / static_cast<double>(order.size())});
        if (auto row = verified_case(*order[i], pictures, keep)) live.push_back(std::move(*row));
    }
    return live;
}

}  // namespace mandelmarch::bench
