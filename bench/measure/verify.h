// SPDX-License-Identifier: Apache-2.0
// Prepares configurations for timing: compares the picture of each with its expected picture.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure/runner.h"
#include "core/image/image.h"
#include "core/render/agreement.h"
#include "core/render/expected.h"

namespace mandelmarch::bench {

// An expected picture.
struct ExpectedPicture {
    std::optional<Case> of;  // a configuration that is compared with it
    std::string name;        // for messages
    Image image;
    RenderStats stats;
};

// Renders the expected pictures. Keeps the last one for exact mode and the last one for fast mode.
class ExpectedPictures {
public:
    explicit ExpectedPictures(const Registry& registry) : registry_(registry) {}

    // Returns the expected picture of a configuration, valid until the next call. Throws Unavailable if the backend
    // that would render it is not available.
    const ExpectedPicture& for_case(const Case& one);

    // Returns true if the configuration itself renders the expected picture of fast mode, so that there is nothing to
    // compare it with. Returns false in exact mode, where the scalar kernel is compared with its own second picture.
    bool renders_expected(const Case& one) const;

    // Returns true if both configurations have the same expected picture.
    bool same(const Case& a, const Case& b) const;

    // Sorts configurations, so that those with the same expected picture follow each other and it is rendered only
    // once. Keeps the order otherwise. case_of(element): the configuration.
    template <class Element, class CaseOf>
    void group(std::vector<Element>& order, CaseOf case_of) const
    {
        for (auto first = order.begin(); first != order.end();) {
            const Case& of = case_of(*first);
            first = std::stable_partition(first, order.end(),
                                          [&](const Element& other) { return same(of, case_of(other)); });
        }
    }

private:
    ExpectedBy source_for(const Case& one) const;

    const Registry& registry_;
    ExpectedPicture exact_, fast_;
};

// Returns true if the configuration's picture agrees well enough with the expected one.
bool passes(const Case& one, const Image& image, const Agreement& found);

// Receives a configuration's picture, right or wrong, after its verification.
using KeepPicture = std::function<void(const Row&, const Image&)>;

// Renders each configuration's picture once, verifies it, and passes it to `keep`. Returns the configurations that can
// be timed; the rows of the others hold the reason.
std::vector<TimedCase> verified_cases(std::vector<Case>& cases, const Registry& registry, const Phase& phase,
                                      const KeepPicture& keep = {});

// Returns a hash of the picture's bytes (FNV-1a, 64 bits).
std::uint64_t fingerprint(const Image& image);

}  // namespace mandelmarch::bench
