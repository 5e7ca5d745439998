// SPDX-License-Identifier: Apache-2.0
// `bench equivalence`: compares exact pictures of extreme scenes bit for bit across backends, devices and SIMD widths.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/render/registry.h"

namespace mandelmarch::bench {

struct EquivalenceOptions {
    std::vector<std::string> backends{};     // names; empty: all
    std::vector<const Fractal*> fractals{};  // empty: all
    int scenes = 1000;                       // number of scenes of all fractals together
    unsigned seed = 1;                       // see core/scene/extreme_scene.h
};

// A tested configuration of a backend in one precision, and the counts of its pictures.
struct Tested {
    std::string backend;
    RendererOptions options;
    std::string device;     // name
    int pictures = 0;       // rendered pictures
    int unavailable = 0;    // scenes that the configuration does not support
    int wrong = 0;          // pictures whose bits or work counts differ, or that failed with an error
    std::string refusal{};  // the reason why the first unsupported scene is not supported

    std::string name() const;  // "vulkan, device 0, in float"
};

// A picture whose bits or work counts differ from those of the scalar kernel (--simd-width 1), or that could not be
// rendered.
struct Discrepancy {
    std::string scene;       // "box-1-17": fractal, seed, index
    std::string parameters;  // contents of the scene's parameter file
    std::string subject;     // Tested::name()
    std::string what;        // the first differing pixel with both values, the work counts, or the error
};

struct EquivalenceResult {  // NOLINT(bugprone-exception-escape): moving ordered_json may throw
    EquivalenceOptions options;
    std::string expected_by;  // name of the backend with the role host, which renders the expected pictures
    nlohmann::ordered_json environment;
    std::vector<Tested> subjects;
    std::vector<std::string> missing;   // backends without a device, and why
    std::vector<std::string> failures;  // backends that could not list their devices
    std::vector<Discrepancy> discrepancies;
};

// Renders each scene in both precisions with the scalar kernel and with every tested configuration. Scenes that would
// be too much work are rendered smaller. Calls `found` with each discrepancy as soon as it is found, and `progress`
// with the completed fraction. If no selected backend can be tested, throws Error if one of them failed, else
// Unavailable.
EquivalenceResult compare_backends(const Registry& registry, const EquivalenceOptions& options,
                                   const std::function<void(const Discrepancy&)>& found,
                                   const std::function<void(double)>& progress);

nlohmann::ordered_json facts_of(const EquivalenceResult& result);

// Returns a table with a line for each tested configuration.
std::string to_console(const EquivalenceResult& result);

}  // namespace mandelmarch::bench
