// SPDX-License-Identifier: Apache-2.0
// Verification before timing: compares the picture of a configuration with the expected one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/study/cases.h"
#include "core/image/image.h"

namespace mandelmarch::bench {

// An expected picture, and a case that must render it.
struct ExpectedPicture {
    std::optional<Case> of;
    std::string name;  // for messages
    Image image;
    RenderStats stats;
};

// Renders the expected pictures. Keeps the last one for exact mode and the last one for fast mode.
// The picture of a configuration is compared with
//   in exact mode: the scalar kernel's on the host (--simd-width 1), in the same precision. The bits must be the same.
//   in fast mode: the reference's canonical picture in double. If the reference would take minutes (more than a million
//     pixels) or does not support the scene, with the scalar kernel's fast picture in double. At most 2 % of the pixels
//     may differ visibly.
//   for the reference itself in exact mode: the scalar kernel's, in double. At most 2 % may differ visibly.
class ExpectedPictures {
public:
    explicit ExpectedPictures(const Registry& registry) : registry_(registry) {}

    // Throws Unavailable if this build has no suitable backend to compare with.
    const ExpectedPicture& for_case(const Case& one);

    // Returns true if the configuration renders the expected picture itself, so that there is nothing to compare with.
    bool renders_expected(const Case& one) const;

    // Returns true if both configurations have the same expected picture.
    bool same(const Case& a, const Case& b) const;

    // Returns the configurations with a backend in an order in which those with the same expected picture follow each
    // other, so that each expected picture is rendered only once.
    std::vector<Case*> grouped(std::vector<Case>& cases) const;

private:
    // Backend and options that render the expected picture.
    struct Source {
        const Backend* backend;
        RendererOptions options;
        std::string name;
    };
    Source source_for(const Case& one) const;

    const Registry& registry_;
    ExpectedPicture exact_, fast_;
};

// Compares a picture, rendered by a backend with this role, with the expected one. Sets row.verification and, if the
// picture is wrong, row.failure.
void verify(Row& row, Role role, const Image& image, const ExpectedPicture& expected);

// Returns a hash of the picture's bytes (FNV-1a, 64 bits).
std::uint64_t fingerprint(const Image& image);

}  // namespace mandelmarch::bench
