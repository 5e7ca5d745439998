// SPDX-License-Identifier: Apache-2.0
// The equivalence check: compares a backend's pictures with the expected ones.
#pragma once

#include <map>
#include <string>

#include "core/render/agreement.h"
#include "core/render/registry.h"
#include "tests/scenes.h"

namespace mandelmarch {

// A line of the printed table: the result for all scenes of a fractal with one backend, device, precision and mode.
struct EquivalenceRow {
    std::string fractal;
    std::string backend;
    std::string device;
    Precision precision;
    Mode mode;
    int scenes = 0;
    Level level = Level::same_bits;  // of the worst scene
    std::uint64_t pixels = 0;
    std::uint64_t differing = 0;  // pixels that differ in a bit of colour or depth, or in a byte
    double largest_ulps = 0;
    std::string first;  // the first differing pixel with both values, and how to trace it; empty if none differs

    bool passed() const { return level <= level_required(mode); }
};

std::string to_text(const EquivalenceRow& row);
std::string equivalence_header();

// Renders the expected pictures and keeps them. In exact mode the scalar kernel renders them. In fast mode they are the
// canonical pictures in double, rendered by `reference` or, if it does not support the fractal, by the scalar kernel.
class Expected {
public:
    explicit Expected(const Registry& registry) : registry_(registry) {}
    const Image& picture(const NamedScene& scene, Precision precision, Mode mode);

    // Returns a note if another backend has rendered this wrong picture in exact mode before; else an empty string.
    std::string suspicion(const NamedScene& scene, Precision precision, const Backend& backend, const Image& wrong);

private:
    const Registry& registry_;
    std::map<std::string, Image> pictures_;
    std::map<std::string, std::pair<std::string, Image>> wrong_;  // the first wrong one of each scene, by a backend
};

// Renders the scenes that have this fractal, all with one renderer, and compares the pictures with the expected ones.
// Throws what the backend throws.
EquivalenceRow check(const Backend& backend, const RendererOptions& options, const std::string& fractal,
                     const std::vector<NamedScene>& scenes, Expected& expected);

}  // namespace mandelmarch
