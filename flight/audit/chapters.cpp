// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/chapters.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/text/error.h"
#include "flight/audit/motion.h"
#include "flight/audit/runs.h"

namespace mandelmarch {
namespace {

// Returns the first frame of a chapter, and the first frame after it.
std::pair<std::size_t, std::size_t> frames_of_chapter(const Path& path, Chapter chapter, int threads)
{
    const Runs runs(path, threads);
    const std::vector<double> clearances = runs.clearances();
    std::vector<Vector> places;
    for (const Frame& frame : path.frames) places.push_back(frame.eye);
    const auto field = [&](std::size_t frame) -> const DistanceField& { return runs.field(frame); };
    const std::vector<Passage> passages = distinct_passages(field, places, clearances);
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
