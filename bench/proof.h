// SPDX-License-Identifier: Apache-2.0
// Verification before timing: compares the picture of a configuration with the expected one.
#pragma once

#include <string>

#include "bench/study.h"
#include "core/image/image.h"

namespace mandelmarch::bench {

// Renders the expected pictures. Keeps the last one for exact mode and the last one for fast mode.
// The picture of a configuration is compared with
//   in exact mode: the scalar kernel's on the host (--pack 1), in the same precision. The bits must be the same.
//   in fast mode: the reference's canonical picture in double. If the reference would take minutes (more than a million
//     pixels) or does not support the scene, with the scalar kernel's fast picture in double. At most 2 % of the pixels
//     may differ visibly.
//   for the reference itself in exact mode: the scalar kernel's, in double. At most 2 % may differ visibly.
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

    // Returns a key that is the same for all configurations with the same expected picture. If configurations are
    // prepared in the order of their keys, each expected picture is rendered only once.
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

// Compares a picture, rendered by a backend with this role, with the expected one. Sets row.proof and, if the picture
// is wrong, row.failure.
void prove(Row& row, Role role, const Image& image, const Yardsticks::Yardstick& yardstick);

// Returns a hash of the picture's bytes (FNV-1a, 64 bits).
std::uint64_t fingerprint(const Image& image);

}  // namespace mandelmarch::bench
