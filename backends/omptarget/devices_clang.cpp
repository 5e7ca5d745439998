// SPDX-License-Identifier: Apache-2.0
// Devices of clang's run-time library, libomptarget. They are the host's cores, by the library's plugin for CPUs, which
// loads kernels as a GPU's plugin does. The library has no query for a device's name and memory.
#include <fmt/format.h>
#include <link.h>
#include <omp.h>
#include <unistd.h>

#include <string>
#include <string_view>

#include "backends/omptarget/devices.h"
#include "core/os/cores.h"

namespace mandelmarch::omptarget {
namespace {

// The plugin loads the kernels from a file in /tmp, and removes the file only when the program ends normally. A
// device process does not end in this way.
int remove_file_of_kernels(dl_phdr_info* object, std::size_t, void*)
{
    if (std::string_view(object->dlpi_name).starts_with("/tmp/tmpfile_")) unlink(object->dlpi_name);
    return 0;
}

// Runs a kernel, because only then the plugin loads the kernels.
void load(int index, job::Chains* chains)
{
    if (chains == nullptr) return;
    const int before = omp_get_default_device();
    omp_set_default_device(index);
    void* sums = omp_target_alloc(job::block_threads * sizeof(float), index);
    chains(sums, job::block_threads, 1, 0, 1);
    omp_target_free(sums, index);
    omp_set_default_device(before);
    dl_iterate_phdr(remove_file_of_kernels, nullptr);
}

}  // namespace

const char* const kind = "offload device";

job::OpenedDevice opened(int index, job::Chains* chains)
{
    load(index, chains);
    const std::string name = fmt::format("offload device {}: the host's cores", index);
    return {
        .device = {.name = name, .vendor = "LLVM's libomptarget", .driver = "compiler " __VERSION__, .is_gpu = false},
        .threads = usable_threads(),
        .peak_threads = 1 << 10,
        .note = fmt::format("runs on the {}", name)};
}

std::optional<std::size_t> free_memory(int) { return std::nullopt; }

}  // namespace mandelmarch::omptarget
