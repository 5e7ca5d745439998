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

// The devices of a backend. Exactly one of the members is not empty.
struct Listing {
    std::vector<Device> devices;
    std::string unavailable;  // why the backend has no devices
    std::string failure;      // how the driver failed while it listed the devices
};

Listing listing_of(const Backend& backend);

// The backend that `--backend auto` selects, and the reason, as a message.
struct AutomaticChoice {
    const Backend* backend;
    std::string reason;
};

class Registry {
public:
    // Keeps backends that only make others (BackendInfo::argument) apart: no function but open() finds them.
    explicit Registry(std::vector<std::unique_ptr<Backend>> backends);

    std::span<const std::unique_ptr<Backend>> backends() const { return backends_; }

    // Returns the backend with this name; nullptr if there is none.
    const Backend* find(std::string_view name) const;

    // Returns the backend with this name, and makes it first if the name is "NAME:argument". Returns nullptr if there
    // is none. Throws what Backend::with_argument() throws.
    const Backend* open(const std::string& name);

    // Returns the first backend with this role; nullptr if there is none.
    const Backend* find(Role role) const;

    // Like find(Role), but throws Unavailable instead of returning nullptr.
    const Backend& with(Role role) const;

    std::vector<std::string> names() const;

    // Returns the first accelerator that has a GPU; if there is none, the host backend. Throws Unavailable if the host
    // backend is missing, too.
    AutomaticChoice automatic() const;

private:
    std::vector<std::unique_ptr<Backend>> backends_, makers_;
};

// Returns a placeholder for a backend that this program does not have or may not use, for the reason `why`.
std::unique_ptr<Backend> without_backend(std::string_view name, std::string_view why);

}  // namespace mandelmarch
