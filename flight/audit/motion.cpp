// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/render/kernel_scene.h"
#include "core/text/error.h"
#include "core/text/quantile.h"
#include "flight/field/threads.h"
#include "flight/path/measures.h"

namespace mandelmarch {
namespace {

constexpr double most_jerk = 0.3;         // threshold, as a multiple of the cube of the pace in clearances / s
constexpr double most_angular_jerk = 30;  // threshold, degrees / s^3
constexpr double some_horizon = 0.25;     // the value of Tilt::horizon for a gaze 30 degrees from vertical
constexpr double level = 30;              // degrees; a picture with a smaller tilt looks level

// Returns, for each frame but the last, the rotation from its camera to the next frame's. A rotation is a vector: its
// direction is the axis, and its length is the angle in radians.
std::vector<Vector> rotations(const Path& path)
{
    const auto camera = [&](std::size_t i) { return camera_of(scene_of(path, path.frames[i], 16, 9)); };
    std::vector<Vector> all;
    all.reserve(path.frames.size());
    Camera before = camera(0);
    for (std::size_t i = 1; i < path.frames.size(); ++i) {
        const Camera now = camera(i);
        const Vector r0 = unit(before.across);
        const Vector u0 = unit(before.upward);
        const Vector r1 = unit(now.across);
        const Vector u1 = unit(now.upward);
        const double trace = dot(before.forward, now.forward) + dot(r0, r1) + dot(u0, u1);
        const Vector axis = 0.5 * (cross(before.forward, now.forward) + cross(r0, r1) + cross(u0, u1));
        const double sine = length(axis);
        const double angle = std::atan2(sine, (trace - 1) / 2);
        all.push_back(sine > 0 ? (angle / sine) * axis : axis);
        before = now;
    }
    return all;
}

double percentile_95(const std::vector<double>& values) { return values.empty() ? 0 : quantile(values, 0.95); }

constexpr int deepest = 7;     // limit on how often the time between two frames is halved
constexpr double even = 0.25;  // "close" in free_between(), in units of the smaller clearance at the two ends

constexpr double narrowing = 2;  // ratio of the clearances outside and inside a passage
// Two passages count as one if the distance between them is less than the larger of these two lengths.
constexpr double same_clearances = 2;  // clearances
constexpr double same_size = 0.02;     // fractal sizes

Scene halfway(const Scene& from, const Scene& to)
{
    Scene scene = to;
    scene.eye = 0.5 * (from.eye + to.eye);
    for (std::size_t i = 0; i < 3; ++i) scene.shape[i] = 0.5 * (from.shape[i] + to.shape[i]);
    scene.escape = 0.5 * (from.escape + to.escape);
    return scene;
}

// Returns the first frame of a chapter, and the first frame after it.
std::pair<std::size_t, std::size_t> frames_of_chapter(const Path& path, Chapter chapter, int threads)
{
    const std::vector<Passage> passages = Runs(path, threads).passages();
    const std::size_t end = path.frames.size();
    const std::size_t first = passages.empty() ? end : passages.front().frame;
    const std::size_t after = passages.empty() ? end : passages.back().frame + 1;
    const auto [begin, behind] = chapter == Chapter::approach   ? std::pair<std::size_t, std::size_t>{0, first}
                                 : chapter == Chapter::passages ? std::pair{first, after}
                                                                : std::pair{after, end};
    if (begin < behind) return {begin, behind};
    throw InputError(fmt::format("--chapter: {} given, but this flight of {} frames has {} narrow place{}",
                                 chapter_names[static_cast<std::size_t>(chapter)], end, passages.size(),
                                 passages.size() == 1 ? "" : "s"));
}

}  // namespace

std::vector<double> turns_of(const Path& path)
{
    std::vector<double> turns{0};
    for (const Vector& rotation : rotations(path)) turns.push_back(length(rotation) * 180 / std::numbers::pi);
    return turns;
}

std::vector<Row> jerk_rows(const Path& path, std::span<const double> clearances)
{
    const double cube = std::pow(path.frames_per_second, 3);
    std::vector<double> jerk;
    for (std::size_t i = 3; i < path.frames.size(); ++i) {
        const auto eye = [&](std::size_t back) { return path.frames[i - back].eye; };
        const Vector third = eye(0) - 3.0 * eye(1) + 3.0 * eye(2) - eye(3);
        jerk.push_back(length(third) * cube / std::max(clearances[i], 1e-300));
    }
    const std::vector<Vector> turned = rotations(path);
    std::vector<double> angular;
    for (std::size_t i = 2; i < turned.size(); ++i) {
        const Vector second = turned[i] - 2.0 * turned[i - 1] + turned[i - 2];
        angular.push_back(length(second) * cube * 180 / std::numbers::pi);
    }
    const double pace = flight_measures(*path.scene.fractal).pace * frames_per_second;
    const double bar = most_jerk * pace * pace * pace;
    return {{"jerk, 95 of 100 frames", percentile_95(jerk), bar, true, false, "DE/s^3"},
            {"angular jerk, 95 of 100 frames", percentile_95(angular), most_angular_jerk, true, false, "deg/s^3"}};
}

Row level_row(const Path& path)
{
    std::size_t horizons = 0;
    std::size_t held = 0;
    const std::vector<Sky> skies = skies_of(path);
    for (std::size_t i = 0; i < skies.size(); ++i) {
        const Tilt tilt = tilt_of(path.frames[i], skies[i].up);
        if (tilt.horizon < some_horizon) continue;
        ++horizons;
        held += std::abs(tilt.angle) < level * std::numbers::pi / 180 ? 1 : 0;
    }
    const double share = horizons > 0 ? 100.0 * static_cast<double>(held) / static_cast<double>(horizons) : 100;
    return {"frames with a horizon that are within 30 deg of level", share, 75, false, false, "%"};
}

Stand longest_stand(std::span<const Vector> places, std::span<const double> radii)
{
    Stand longest;
    std::size_t outside = 0;  // index of the first place outside the last stand's radius
    for (std::size_t i = 0; i + longest.steps + 1 < places.size(); ++i) {
        const auto within = [&](std::size_t j) {
            ++longest.distances;
            return length(places[j] - places[i]) <= radii[i];
        };
        // If the stand that begins at i is longer than the longest so far, it includes `far` and every place before
        // `far`. Among these, the place `outside`, which ended the last stand, is the most likely to end this one, too.
        // Therefore these two places are tested before the others.
        const std::size_t far = i + longest.steps + 1;
        if (!within(far) || (outside > i && outside < far && !within(outside))) continue;
        outside = i + 1;
        while (outside < places.size() && within(outside)) ++outside;
        if (outside - 1 - i > longest.steps) {
            longest.steps = outside - 1 - i;
            longest.first = i;
        }
    }
    return longest;
}

Runs::Runs(const Path& path, int threads) : path_(path)
{
    const auto same = [](const Changes& a, const Changes& b) {
        return a.shape == b.shape && a.iterations == b.iterations && a.escape == b.escape;
    };
    for (std::size_t i = 0; i < path.frames.size(); ++i) {
        if (i == 0 || !same(path.frames[i].changes, path.frames[i - 1].changes)) {
            runs_.push_back({i, i, std::make_unique<DistanceField>(scene_of(path, path.frames[i], 16, 9), threads)});
        }
        runs_.back().last = i + 1;
        of_.push_back(runs_.size() - 1);
        places_.push_back(path.frames[i].eye);
    }
    clearances_.resize(places_.size());
    parallel(runs_.size(), 16, this->threads(), [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r) {
            const auto [begin, end] = std::pair(runs_[r].first, runs_[r].last);
            runs_[r].field->distances(std::span(places_).subspan(begin, end - begin),
                                      std::span(clearances_).subspan(begin, end - begin));
        }
    });
}

std::vector<Passage> Runs::passages() const
{
    return distinct_passages([this](std::size_t frame) -> const DistanceField& { return field(frame); }, places_,
                             clearances_);
}

bool Runs::free_before(std::size_t frame) const
{
    const Vector from = path_.frames[frame - 1].eye;
    const Vector to = path_.frames[frame].eye;
    const double way = length(to - from);
    // Returns true if the segment from a to b meets no solid of `shape`. `clearance`: the estimate at a.
    const auto straight = [&](const DistanceField& shape, Vector a, Vector b, double clearance) {
        const double floor = in_solid * shape.bounds().size;
        return way <= shape.safety() * clearance || shape.least_between(a, b, floor) > floor;
    };
    if (!straight(field(frame), to, from, clearances_[frame])) return false;
    if (!changed(frame)) return true;
    if (!straight(field(frame - 1), from, to, clearances_[frame - 1])) return false;
    const auto moment = [&](std::size_t i) { return Moment{scene_of(path_, path_.frames[i], 16, 9), clearances_[i]}; };
    return free_between(moment(frame - 1), moment(frame), in_solid * field(frame).bounds().size, 0);
}

bool Runs::free_between(const Moment& from, const Moment& to, double floor, int depth)
{
    Moment middle{halfway(from.scene, to.scene), 0};
    middle.clearance = DistanceField(middle.scene, 1).distance(middle.scene.eye);
    if (middle.clearance <= floor) return false;
    const double mean = 0.5 * (from.clearance + to.clearance);
    if (std::abs(middle.clearance - mean) <= even * std::min(from.clearance, to.clearance) || depth == deepest)
        return true;
    return free_between(from, middle, floor, depth + 1) && free_between(middle, to, floor, depth + 1);
}

double Runs::wall_step(std::size_t frame) const
{
    if (!changed(frame)) return 0;
    const double before = field(frame - 1).distance(path_.frames[frame].eye);
    const double now = clearances_[frame];
    return std::abs(now - before) / std::max(std::min(now, before), 1e-300);
}

std::vector<Passage> distinct_passages(const FieldOf& field, std::span<const Vector> places,
                                       std::span<const double> clearances)
{
    std::vector<Passage> passages;
    std::vector<Vector> known;
    // Once the clearance has fallen to half of `widest` or less, `least` holds the frame with the smallest clearance
    // since then. `least` is a passage if the clearance then grows to twice the clearance of `least`.
    double widest = 0;  // the largest clearance since the last passage
    bool narrowed = false;
    Passage least{0, 0};
    for (std::size_t i = 0; i < clearances.size(); ++i) {
        const double here = clearances[i];
        if (!narrowed) {
            widest = std::max(widest, here);
            if (narrowing * here > widest) continue;
            narrowed = true;
            least = {i, here};
            continue;
        }
        if (here < least.clearance) least = {i, here};
        if (here < narrowing * least.clearance) continue;
        narrowed = false;
        widest = here;
        const DistanceField& there = field(least.frame);
        if (!there.bounds().contains(places[least.frame])) continue;
        const Vector place = there.representative(places[least.frame]);
        const double apart = std::max(same_clearances * least.clearance, same_size * there.bounds().size);
        if (std::ranges::any_of(known, [&](Vector k) { return length(k - place) < apart; })) continue;
        known.push_back(place);
        passages.push_back(least);
    }
    return passages;
}

std::pair<std::size_t, std::size_t> frames_of(const Path& path, const Part& part, int threads)
{
    const auto [begin, behind] = part.chapter ? frames_of_chapter(path, *part.chapter, threads)
                                              : std::pair<std::size_t, std::size_t>{0, path.frames.size()};
    const auto frames = static_cast<double>(behind - begin);
    const double rate = path.frames_per_second;
    const double from = std::round(part.from.value_or(0) * rate);
    const double to = std::round(part.to.value_or(frames / rate) * rate);
    if (0 <= from && from < to && to <= frames) {
        return {begin + static_cast<std::size_t>(from), begin + static_cast<std::size_t>(to) - 1};
    }
    throw InputError(fmt::format("--from, --to: {:.6g} to {:.6g} s given, expected a part of the {:.6g} s of the {}",
                                 from / rate, to / rate, frames / rate, part.chapter ? "chapter" : "flight"));
}

}  // namespace mandelmarch
