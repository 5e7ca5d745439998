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

// What a backend has. Of the three one is not empty.
struct Listing {
    std::vector<Device> devices;
    std::string unavailable;  // why there are none
    std::string failure;      // how its driver failed while it listed them
};

Listing listing_of(const Backend& backend);

// What `auto` chose, and why, in words for the user.
struct AutomaticChoice {
    const Backend* backend;
    std::string reason;
};

class Registry {
public:
    explicit Registry(std::vector<std::unique_ptr<Backend>> backends) : backends_(std::move(backends)) {}

    std::span<const std::unique_ptr<Backend>> backends() const { return backends_; }

    // nullptr if there is no such backend.
    const Backend* find(std::string_view name) const;

    // The first one with the role; nullptr if there is none.
    const Backend* find(Role role) const;

    // As find(Role), but throws Unavailable where this program has none.
    const Backend& with(Role role) const;

    std::vector<std::string> names() const;

    // An accelerator that has a GPU, else the host.
    AutomaticChoice automatic() const;

private:
    std::vector<std::unique_ptr<Backend>> backends_;
};

// An unavailable backend: the program was built without it, for the reason `why`.
std::unique_ptr<Backend> without_backend(std::string_view name, std::string_view why);

}  // namespace mandelmarch
