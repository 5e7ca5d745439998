// SPDX-License-Identifier: Apache-2.0
// Chapters: the parts of a flight, by the narrow places that it passes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "flight/path/path.h"

namespace mandelmarch {

// approach: the frames before the first narrow place. passages: the frames from the first narrow place to the last one.
// out: the frames after the last narrow place.
enum class Chapter { approach, passages, out };
inline constexpr std::array<std::string_view, 3> chapter_names{"approach", "passages", "out"};

// A part of a flight.
struct Part {
    std::optional<Chapter> chapter;  // nullopt: the whole flight
    std::optional<double> from, to;  // seconds since the beginning of the chapter

    bool whole() const { return !chapter && !from && !to; }
};

// Returns the first and the last frame of a part that is not the whole flight. The narrow places are those that the
// audit counts as distinct passages. Throws InputError if the flight does not have the chapter or the seconds.
std::pair<std::size_t, std::size_t> frames_of(const Path& path, const Part& part, int threads);

}  // namespace mandelmarch
