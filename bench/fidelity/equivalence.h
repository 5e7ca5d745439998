// SPDX-License-Identifier: Apache-2.0
// Compares pictures with the expected ones (core/render/expected.h) across backends, devices and SIMD widths: those of
// extreme scenes for `bench equivalence`, those of other scenes for tests.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/render/registry.h"
#include "core/scene/random_scene.h"

namespace mandelmarch::bench {

struct EquivalenceOptions {
    std::vector<std::string> backends{};     // names; empty: all
    std::vector<const Fractal*> fractals{};  // empty: all
    int scenes = 1000;                       // number of scenes of all fractals together
    unsigned seed = 1;                       // see core/scene/random_scene.h
    Mode mode = Mode::exact;
    std::vector<NamedScene> others{};  // rendered instead of extreme scenes
};

// A tested configuration of a backend in one precision, and the counts of its pictures.
struct Tested {
    std::string backend;
    RendererOptions options;
    std::string device;     // name
    int pictures = 0;       // rendered pictures
    int unavailable = 0;    // scenes that the configuration does not support
    int wrong = 0;          // pictures that disagree with the expected ones, or that failed with an error
    std::string refusal{};  // the reason why the first unsupported scene is not supported

    std::string name() const;  // "vulkan, device 0, in float"
};

// A picture that disagrees with the expected one, or that could not be rendered.
struct Discrepancy {
    std::string scene;       // its name, or "box-1-17": fractal, seed, index
    std::string parameters;  // contents of the scene's parameter file
    std::string subject;     // Tested::name()
    // The first differing pixel with both values, the work counts, or the error. If another backend has rendered the
    // same picture, says that the expected picture is suspect.
    std::string what;
};

struct EquivalenceResult {  // NOLINT(bugprone-exception-escape): moving ordered_json may throw
    EquivalenceOptions options;
    nlohmann::ordered_json environment;  // set by the caller
    std::vector<Tested> subjects;
    std::vector<std::string> missing;   // backends without a device, and why
    std::vector<std::string> failures;  // backends that could not list their devices
    std::vector<Discrepancy> discrepancies;
};

// Renders each scene in both precisions with every tested configuration. In exact mode, bits and work counts must be
// the expected ones; in fast mode, pictures must agree perceptually. Extreme scenes that would be too much work are
// rendered smaller. Calls `found` with each discrepancy as soon as it is found, and `progress` with the completed
// fraction. If no selected backend can be tested, throws Error if one of them failed, else Unavailable.
EquivalenceResult compare_backends(
    const Registry& registry, const EquivalenceOptions& options,
    const std::function<void(const Discrepancy&)>& found = [](const Discrepancy&) {},
    const std::function<void(double)>& progress = [](double) {});

nlohmann::ordered_json facts_of(const EquivalenceResult& result);

// Returns a table with a line for each tested configuration.
std::string to_console(const EquivalenceResult& result);

}  // namespace mandelmarch::bench
