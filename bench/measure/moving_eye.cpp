// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/moving_eye.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/compare.h"
#include "core/render/agreement.h"

namespace mandelmarch::bench {
namespace {

// The eye moves by a fraction of its distance to the target: first_move, doubled until at least least_change of the
// pixels differ visibly from the picture of the scene's own view, or until it exceeds last_move.
constexpr double first_move = 0.01;
constexpr double last_move = 0.1;
constexpr double least_change = 0.1;

}  // namespace

std::size_t MovingEye::group_of(const Case& one)
{
    const auto found = std::ranges::find_if(groups_, [&](const Group& group) { return pictures_.same(group.of, one); });
    if (found != groups_.end()) return static_cast<std::size_t>(found - groups_.begin());
    Image bytes(one.scene.width, one.scene.height, Image::Layers::bytes);
    bytes.bytes() = pictures_.for_case(one).image.bytes();
    groups_.push_back({one, std::move(bytes), first_move});
    return groups_.size() - 1;
}

Case MovingEye::moved(const Case& one, double share)
{
    std::normal_distribution<double> normal;
    const Vector to{normal(random_), normal(random_), normal(random_)};
    Case other = one;
    const Vector away = one.scene.eye - one.scene.target;
    other.scene.eye = one.scene.eye + (share * length(away) / length(to)) * to;
    return other;
}

const Case& MovingEye::view_of(const Case& one)
{
    const std::size_t index = group_of(one);
    if (const auto kept = views_.find(index); kept != views_.end()) return kept->second;
    Group& group = groups_[index];
    for (;; group.share *= 2) {
        Case view = moved(group.of, group.share);
        const Comparison change = compare(group.own, pictures_.for_case(view).image);
        const bool visible =
            static_cast<double>(change.visibly_differing) >= least_change * static_cast<double>(change.pixels);
        if (!visible && group.share <= last_move) continue;
        const std::string blind = fmt::format(
            "{}: nearby views look alike: a picture kept from an earlier run is not noticed", one.row.fractal);
        if (!visible && std::ranges::find(warnings_, blind) == warnings_.end()) warnings_.push_back(blind);
        return views_.emplace(index, std::move(view)).first->second;
    }
}

std::string MovingEye::fault_of(const Case& one, const Image& image)
{
    const ExpectedPicture& expected = pictures_.for_case(view_of(one));
    const Agreement found = agreement(expected.image, image, one.options.precision);
    if (passes(one, image, found)) return {};
    return fmt::format("the timed picture of a view nearby is wrong: {} of {} pixels differ, {} visibly",
                       found.comparison.differing, found.comparison.pixels, found.comparison.visibly_differing);
}

}  // namespace mandelmarch::bench
