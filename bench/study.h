// SPDX-License-Identifier: Apache-2.0
// The named studies: which rows there are.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bench/options.h"
#include "bench/result.h"
#include "core/render/registry.h"
#include "core/scene/scene.h"

namespace mandelmarch::bench {

struct Study {
    std::string_view name;
    std::string_view varies;  // what is drawn on the x axis; empty where nothing varies
    std::string_view about;
};

std::span<const Study> studies();

// Throws InputError with the known names.
const Study& study_named(std::string_view name);

// A row that is to be measured, and how it is drawn.
struct Case {
    Row row;
    Scene scene;
    RendererOptions options;
    const Backend* backend = nullptr;  // nullptr in a row of a backend without devices
};

// True if `asked`, the value of --backend (`all` or names separated by commas), includes the backend.
bool names_backend(std::string_view asked, std::string_view backend);

// Throws InputError for a name that the registry does not know.
void check_backends(const Registry& registry, std::string_view asked);

// Every row of the study that the options choose. A backend without any device is one row, which says why.
// Throws InputError for an unknown name or a bad size.
std::vector<Case> cases_of(const Registry& registry, const Options& options);

// The fractals that --fractal chooses, by nickname: for all, those whose rows say that they are studied.
std::vector<std::string> fractals_of(std::string_view option);
std::vector<Precision> precisions_of(const Options& options);
std::vector<Mode> modes_of(const Options& options);

// Width and height, in pixels, of the option or else of the study. Throws InputError.
std::pair<int, int> size_of(const Options& options);

// The name of the platform that a device is: a GPU's own, or Cpu::platform() for all devices that run on the CPU.
std::string platform_of(const Device& device);

}  // namespace mandelmarch::bench
