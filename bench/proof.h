// SPDX-License-Identifier: Apache-2.0
// Verification before timing: compares the picture of a configuration with the expected one.
#pragma once

#include <string>

#include "bench/study.h"
#include "core/image/image.h"

namespace mandelmarch::bench {

// Renders the expected pictures, and keeps the last one of each kind.
//   exact configurations: the scalar kernel on the host (--pack 1), in the same precision; the bits must be the same.
//   fast configurations: the reference's canonical picture in double; or the scalar kernel if the reference would take
//     minutes (more than a million pixels) or does not support the scene. At most 2 % of the pixels may differ visibly.
//   the reference itself in exact mode: the scalar kernel in double; at most 2 % of the pixels may differ visibly.
class Yardsticks {
public:
    explicit Yardsticks(const Registry& registry) : registry_(registry) {}

    struct Yardstick {
        std::string key;
        std::string name;  // for messages
        Image image;
        RenderStats report;
    };

    // Throws Unavailable if this build has no suitable backend to compare with.
    const Yardstick& for_case(const Case& one);

    // Returns true if the configuration renders the expected picture itself, so that there is nothing to compare with.
    bool is_yardstick(const Case& one) const;

    // Returns the same key for configurations with the same expected picture. Rendering cases in the order of their
    // keys renders each expected picture once.
    std::string key(const Case& one) const;

private:
    // Backend and options that render the expected picture.
    struct Source {
        const Backend* backend;
        RendererOptions options;
        std::string name;
    };
    Source source_for(const Case& one) const;

    const Registry& registry_;
    Yardstick exact_, fast_;
};

// Compares a picture, rendered by a backend of this role, with the expected one and fills in row.proof.
void prove(Row& row, Role role, const Image& image, const Yardsticks::Yardstick& yardstick);

// Returns a hash of the picture's bytes (FNV-1a, 64 bits).
std::uint64_t fingerprint(const Image& image);

}  // namespace mandelmarch::bench
