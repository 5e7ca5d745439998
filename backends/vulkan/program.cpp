// SPDX-License-Identifier: Apache-2.0
#include "backends/vulkan/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "core/text/environment.h"
#include "core/text/hash.h"
#include "core/os/input_file.h"
#include "core/os/output_file.h"

namespace mandelmarch::vulkan {
namespace {

using Bytes = std::vector<std::uint8_t>;

// The cache file consists of this header and the bytes of the driver's cache.
struct FileHeader {
    std::array<char, 8> magic;
    std::uint64_t checksum;
};
constexpr std::array<char, 8> magic{'m', 'm', 'v', 'k', 'c', 'a', '0', '1'};

std::string cache_folder()
{
    // The XDG Base Directory Specification requires that an empty or relative path is ignored.
    if (const std::string xdg = environment_variable("XDG_CACHE_HOME"); xdg.starts_with('/')) {
        return xdg + "/mandelmarch";
    }
    if (const std::string home = environment_variable("HOME"); home.starts_with('/')) {
        return home + "/.cache/mandelmarch";
    }
    return {};
}

// Returns the content of the cache file without its header; empty if the file is missing or damaged.
Bytes read_cache(const std::string& path)
{
    const std::string bytes = own_file(path).value_or("");
    FileHeader header{};
    if (bytes.size() < sizeof header) return {};
    std::memcpy(&header, bytes.data(), sizeof header);
    Bytes content(bytes.begin() + sizeof header, bytes.end());
    if (header.magic != magic || header.checksum != fnv1a(content.data(), content.size())) return {};
    return content;
}

// Returns true if the header that the driver wrote into its cache names this device. Drivers must check this
// themselves, but some did not.
bool is_of(const vk::PhysicalDeviceProperties& device, const Bytes& content)
{
    VkPipelineCacheHeaderVersionOne header{};
    if (content.size() < sizeof header) return false;
    std::memcpy(&header, content.data(), sizeof header);
    return header.headerSize >= sizeof header && header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == device.vendorID && header.deviceID == device.deviceID &&
           std::equal(std::begin(header.pipelineCacheUUID), std::end(header.pipelineCacheUUID),
                      device.pipelineCacheUUID.begin());
}

}  // namespace

PipelineCache::PipelineCache(const Gpu& gpu, Module module)
{
    const auto& properties = gpu.info().properties;
    if (const std::string folder = cache_folder(); !folder.empty()) {
        std::string uuid;
        for (const std::uint8_t byte : properties.pipelineCacheUUID) uuid += fmt::format("{:02x}", byte);
        path_ = fmt::format("{}/vulkan-{}-{:08x}-{:016x}.bin", folder, uuid, properties.driverVersion,
                            fnv1a(module.data(), module.size_bytes()));
        known_ = read_cache(path_);
        if (!is_of(properties, known_)) known_.clear();
    }
    handle_ = attempt(gpu.name(), "opening a pipeline cache", [&] {
        return gpu.device().createPipelineCache(vk::PipelineCacheCreateInfo({}, known_.size(), known_.data()));
    });
}

void PipelineCache::save()
{
    if (path_.empty()) return;
    try {
        const Bytes content = handle_.getData();
        if (content == known_) return;
        std::error_code ignored;
        std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), ignored);
        const FileHeader header{magic, fnv1a(content.data(), content.size())};
        OutputFile file(path_, NamedBy::program);
        file.write(&header, sizeof header);
        file.write(content.data(), content.size());
        file.commit();
        known_ = content;
    } catch (const std::exception&) {
        path_.clear();  // the renderer continues without a cache
    }
}

Program::Program(const Gpu& gpu, Module module, int buffers) : device_(gpu.device()), cache_(gpu, module)
{
    attempt(gpu.name(), "loading a shader", [&] {
        const auto count = static_cast<std::uint32_t>(buffers);
        module_ = device_.createShaderModule(vk::ShaderModuleCreateInfo({}, module.size_bytes(), module.data()));
        std::vector<vk::DescriptorSetLayoutBinding> bindings;
        for (std::uint32_t i = 0; i < count; ++i) {
            bindings.emplace_back(i, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute);
        }
        set_layout_ = device_.createDescriptorSetLayout(vk::DescriptorSetLayoutCreateInfo({}, bindings));
        const vk::PushConstantRange pushed(vk::ShaderStageFlagBits::eCompute, 0, sizeof(Pushed));
        layout_ = device_.createPipelineLayout(vk::PipelineLayoutCreateInfo({}, *set_layout_, pushed));
        const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer, count);
        pool_ = device_.createDescriptorPool(vk::DescriptorPoolCreateInfo({}, 1, size));
        // The set is released together with its pool, because the pool cannot free single sets.
        set_ = vk::raii::DescriptorSets(device_, vk::DescriptorSetAllocateInfo(*pool_, *set_layout_)).front().release();
    });
}

void Program::bind(std::span<const Binding> bindings) const
{
    std::vector<vk::DescriptorBufferInfo> infos;
    infos.reserve(bindings.size());
    for (const Binding& binding : bindings) infos.emplace_back(*binding.buffer->handle, binding.offset, binding.size);
    device_.updateDescriptorSets(vk::WriteDescriptorSet(set_, 0, 0, vk::DescriptorType::eStorageBuffer, {}, infos), {});
}

const vk::raii::Pipeline& Program::pipeline(const Gpu& gpu, const Ints& constants)
{
    const auto found = pipelines_.find(constants);
    if (found != pipelines_.end()) return found->second;
    return attempt(gpu.name(), "building a pipeline", [&]() -> const vk::raii::Pipeline& {
        std::array<vk::SpecializationMapEntry, std::tuple_size_v<Ints>> entries;
        for (std::uint32_t i = 0; i < entries.size(); ++i) entries[i] = vk::SpecializationMapEntry(i, i * 4, 4);
        const vk::SpecializationInfo specialization(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                                    sizeof constants, constants.data());
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module_, "main",
                                                      &specialization);
        auto made = device_.createComputePipeline(cache_.handle(), vk::ComputePipelineCreateInfo({}, stage, *layout_));
        cache_.save();
        return pipelines_.emplace(constants, std::move(made)).first->second;
    });
}

void Program::dispatch(Gpu& gpu, const Ints& constants, const Pushed& pushed, std::uint32_t groups_x,
                       std::uint32_t groups_y)
{
    const vk::raii::Pipeline& ready = pipeline(gpu, constants);
    const vk::raii::CommandBuffer& commands = gpu.commands();
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *ready);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, set_, {});
    commands.pushConstants<std::int32_t>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, pushed);
    commands.dispatch(groups_x, groups_y, 1);
}

}  // namespace mandelmarch::vulkan
