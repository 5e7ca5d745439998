// SPDX-License-Identifier: Apache-2.0
// Stores the pipelines that a driver has compiled, for later runs, in $XDG_CACHE_HOME/mandelmarch or
// ~/.cache/mandelmarch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "backends/vulkan/gpu.h"
#include "backends/vulkan/modules.h"

namespace mandelmarch::vulkan {

// The cached pipelines of one module on one device. A file that is truncated, modified or from another driver is
// ignored and rewritten. If the folder is not writable, or the path is not a regular file, nothing is stored, and no
// error is reported.
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
