// SPDX-License-Identifier: Apache-2.0
// What a driver made of a module, kept for the next run in $XDG_CACHE_HOME/mandelmarch or ~/.cache/mandelmarch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "backends/vulkan/gpu.h"
#include "backends/vulkan/modules.h"

namespace mandelmarch::vulkan {

// A file that is truncated, changed or another driver's is ignored and written anew; a folder that cannot be written,
// or what is no file in its place, means no cache, silently.
class PipelineCache {
public:
    PipelineCache(const Gpu& gpu, Module module);

    const vk::raii::PipelineCache& handle() const { return handle_; }

    // Writes what has come to it since it was opened.
    void save();

private:
    std::string path_;  // empty: no cache
    std::vector<std::uint8_t> known_;
    vk::raii::PipelineCache handle_ = nullptr;
};

}  // namespace mandelmarch::vulkan
