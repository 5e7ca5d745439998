// SPDX-License-Identifier: Apache-2.0
// Named studies and the configurations that each contains.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bench/options.h"
#include "bench/studies.h"
#include "core/render/registry.h"
#include "core/scene/scene.h"

namespace mandelmarch::bench {

// A configuration to measure, with the scene and options to render it.
struct Case {
    Row row;
    Scene scene;
    RendererOptions options;
    const Backend* backend = nullptr;  // nullptr if the backend has no device
};

// Returns true if `asked`, the value of --backend (`all` or names separated by commas), includes the backend.
bool names_backend(std::string_view asked, std::string_view backend);

// Throws InputError if a name in `asked` is not that of a backend in the registry.
void check_backends(const Registry& registry, std::string_view asked);

// Returns all configurations of the study that the options select. A backend without a device is one configuration,
// which holds the reason. Throws InputError for an unknown name or an invalid size.
std::vector<Case> cases_of(const Registry& registry, const Options& options);

// Returns the short names of the fractals that --fractal selects; for all, those studied by default.
std::vector<std::string> fractals_of(std::string_view option);
std::vector<Precision> precisions_of(const Options& options);
std::vector<Mode> modes_of(const Options& options);

// Returns width and height in pixels, from --size or, if it is not given, from the study. Throws InputError for an
// invalid size.
std::pair<int, int> size_of(const Options& options);

// Returns the name of the device's platform: the GPU's name, or Cpu::platform() for any device that runs on the CPU.
std::string platform_of(const Device& device);

}  // namespace mandelmarch::bench
