// SPDX-License-Identifier: Apache-2.0
// `bench equivalence`: exact pictures of extreme scenes by every backend, device and pack width, bit for bit.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/render/registry.h"

namespace mandelmarch::bench {

struct EquivalenceOptions {
    std::string backend = "all";
    std::string fractal = "all";
    int scenes = 1000;  // in all
    unsigned seed = 1;  // core/scene/extreme_scene.h
};

// What draws, in one precision, and how it did.
struct Subject {
    std::string backend;
    RendererOptions options;
    std::string device;     // its name
    int pictures = 0;       // that were drawn
    int unavailable = 0;    // scenes that it refuses
    int wrong = 0;          // pictures with other bits or other work, or none because of an error
    std::string refusal{};  // the first one's reason

    std::string name() const;  // "vulkan, device 0, in float"
};

// A picture that is not that of the host's scalar text (--pack 1).
struct Discrepancy {
    std::string scene;       // "box-1-17": fractal, seed, number
    std::string parameters;  // the text of its parameter file
    std::string subject;
    std::string what;  // the first differing pixel with both values, or the error
};

struct EquivalenceResult {
    EquivalenceOptions options;
    std::string yardstick;  // the backend with the role of the host
    nlohmann::ordered_json environment;
    std::vector<Subject> subjects;
    std::vector<std::string> missing;   // backends without a device, and why
    std::vector<std::string> failures;  // of backends that could not list their devices
    std::vector<Discrepancy> discrepancies;
};

// Draws each scene in both precisions by the host's scalar text and by every subject; a scene that is too much work is
// drawn smaller. `found` is called with each discrepancy at once, `progress` with the finished share. Throws InputError
// for an unknown backend or fractal; where nothing is left to compare Error, or Unavailable without a device.
EquivalenceResult compare_backends(const Registry& registry, const EquivalenceOptions& options,
                                   const std::function<void(const Discrepancy&)>& found,
                                   const std::function<void(double)>& progress);

nlohmann::ordered_json json_of(const EquivalenceResult& result);

// A line for each subject.
std::string to_console(const EquivalenceResult& result);

}  // namespace mandelmarch::bench
