// SPDX-License-Identifier: Apache-2.0
// The backends of this program, by name.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/render/backend.h"

namespace mandelmarch {

// Devices of a backend; exactly one member is not empty.
struct Listing {
    std::vector<Device> devices;
    std::string unavailable;  // why it has no devices
    std::string failure;      // how its driver failed while listing devices
};

Listing listing_of(const Backend& backend);

// The backend selected by `auto`, with the reason as a message.
struct AutomaticChoice {
    const Backend* backend;
    std::string reason;
};

class Registry {
public:
    explicit Registry(std::vector<std::unique_ptr<Backend>> backends) : backends_(std::move(backends)) {}

    std::span<const std::unique_ptr<Backend>> backends() const { return backends_; }

    // Returns nullptr if no backend has the name.
    const Backend* find(std::string_view name) const;

    // Returns the first backend with the role; nullptr if none has it.
    const Backend* find(Role role) const;

    // As find(Role), but throws Unavailable instead of returning nullptr.
    const Backend& with(Role role) const;

    std::vector<std::string> names() const;

    // Selects an accelerator that has a GPU, otherwise the host.
    AutomaticChoice automatic() const;

private:
    std::vector<std::unique_ptr<Backend>> backends_;
};

// Returns an unavailable backend: the program was built without it, for the reason `why`.
std::unique_ptr<Backend> without_backend(std::string_view name, std::string_view why);

}  // namespace mandelmarch
