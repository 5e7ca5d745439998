// SPDX-License-Identifier: Apache-2.0
// Proof before timing: what a row draws, compared with what it should draw.
#pragma once

#include <string>

#include "bench/study.h"
#include "core/image/image.h"

namespace mandelmarch::bench {

// Draws the pictures that others are compared with, and keeps the last one of each kind.
//   exact rows: the host's scalar text (--pack 1), in the row's precision; the same bits are required.
//   fast rows: the reference's canonical picture in double, or the host's scalar text where the reference would take
//   minutes (more than a million pixels) or does not draw the scene; at most 2 % of the pixels may be visibly off. The
//   reference itself in exact mode: the host's scalar text in double; at most 2 % of the pixels visibly off.
class Yardsticks {
public:
    explicit Yardsticks(const Registry& registry) : registry_(registry) {}

    struct Yardstick {
        std::string key;
        std::string name;  // for messages
        Image image;
        RenderReport report;
    };

    // Throws Unavailable where this build has nothing to compare with.
    const Yardstick& for_case(const Case& one);

    // True if the row is a yardstick itself: it has nothing to be compared with.
    bool is_yardstick(const Case& one) const;

    // Rows that share a yardstick have the same key; drawing cases in the order of their keys draws each yardstick
    // once.
    std::string key(const Case& one) const;

private:
    // What draws the yardstick of a row.
    struct Source {
        const Backend* backend;
        RendererOptions options;
        std::string name;
    };
    Source source_for(const Case& one) const;

    const Registry& registry_;
    Yardstick exact_, fast_;
};

// Compares the picture of a row, which a backend of this role drew, and fills the proof in.
void prove(Row& row, Role role, const Image& image, const Yardsticks::Yardstick& yardstick);

// A number of the picture's bytes that tells it from others (FNV-1a, 64 bits).
std::uint64_t fingerprint(const Image& image);

}  // namespace mandelmarch::bench
