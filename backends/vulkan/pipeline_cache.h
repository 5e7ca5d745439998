// SPDX-License-Identifier: Apache-2.0
// Cache of driver-compiled pipelines between runs, in $XDG_CACHE_HOME/mandelmarch or ~/.cache/mandelmarch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "backends/vulkan/gpu.h"
#include "backends/vulkan/modules.h"

namespace mandelmarch::vulkan {

// A file that is truncated, modified or from another driver is ignored and rewritten. If the folder is not writable, or
// the path is not a file, nothing is cached, without a message.
class PipelineCache {
public:
    PipelineCache(const Gpu& gpu, Module module);

    const vk::raii::PipelineCache& handle() const { return handle_; }

    // Writes the cache if it has changed since it was opened.
    void save();

private:
    std::string path_;  // empty: no cache
    std::vector<std::uint8_t> known_;
    vk::raii::PipelineCache handle_ = nullptr;
};

}  // namespace mandelmarch::vulkan
