// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/runs.h"

#include <algorithm>
#include <cmath>

#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

constexpr int deepest = 7;     // limit on how often the time between two frames is halved
constexpr double even = 0.25;  // "close" in free_between(), in units of the smaller clearance at the two ends

Scene halfway(const Scene& from, const Scene& to)
{
    Scene scene = to;
    scene.eye = 0.5 * (from.eye + to.eye);
    for (std::size_t i = 0; i < 3; ++i) scene.shape[i] = 0.5 * (from.shape[i] + to.shape[i]);
    scene.escape = 0.5 * (from.escape + to.escape);
    return scene;
}

}  // namespace

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
    }
}

std::vector<double> Runs::clearances() const
{
    std::vector<Vector> places;
    for (const Frame& frame : path_.frames) places.push_back(frame.eye);
    std::vector<double> clearances(places.size());
    parallel(runs_.size(), 16, threads(), [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r) {
            const auto [begin, end] = std::pair(runs_[r].first, runs_[r].last);
            runs_[r].field->distances(std::span(places).subspan(begin, end - begin),
                                      std::span(clearances).subspan(begin, end - begin));
        }
    });
    return clearances;
}

bool Runs::free_before(std::size_t frame, std::span<const double> clearances) const
{
    const Vector from = path_.frames[frame - 1].eye;
    const Vector to = path_.frames[frame].eye;
    const double way = length(to - from);
    // Returns true if the segment from a to b meets no solid of `shape`. `clearance`: the estimate at a.
    const auto straight = [&](const DistanceField& shape, Vector a, Vector b, double clearance) {
        const double floor = in_solid * shape.bounds().size;
        return way <= shape.safety() * clearance || shape.least_between(a, b, floor) > floor;
    };
    if (!straight(field(frame), to, from, clearances[frame])) return false;
    if (!changed(frame)) return true;
    if (!straight(field(frame - 1), from, to, clearances[frame - 1])) return false;
    const auto moment = [&](std::size_t i) { return Moment{scene_of(path_, path_.frames[i], 16, 9), clearances[i]}; };
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

double Runs::wall_step(std::size_t frame, std::span<const double> clearances) const
{
    if (!changed(frame)) return 0;
    const double before = field(frame - 1).distance(path_.frames[frame].eye);
    const double now = clearances[frame];
    return std::abs(now - before) / std::max(std::min(now, before), 1e-300);
}

}  // namespace mandelmarch
