// SPDX-License-Identifier: Apache-2.0
// Loads and launches kernels whose PTX is embedded in the program.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <mutex>
#include <vector>

#include "backends/cuda/driver.h"
#include "core/job/job.h"
#include "core/render/backend.h"

// Embeds a text file as a string with this name.
#define MM_TEXT(name, file)                                                                        \
    extern "C" {                                                                                   \
    extern const char mandelmarch_cuda_##name[] __attribute__((visibility("hidden")));             \
    }                                                                                              \
    asm(".pushsection .rodata\n.globl mandelmarch_cuda_" #name "\n.hidden mandelmarch_cuda_" #name \
        "\nmandelmarch_cuda_" #name ":\n.incbin \"" file "\"\n.byte 0\n.popsection\n");            \
    static constexpr const char* name = mandelmarch_cuda_##name;

namespace mandelmarch::cuda {

// A kernel, loaded once for each device that uses it.
class Module {
public:
    Module(const char* ptx, const char* name) : ptx_(ptx), name_(name) {}

    // Loads the kernel on the calling thread's device. The driver translates the PTX for that device.
    void load() { static_cast<void>(loaded()); }
    // Launches at least `threads` threads, rounded up to whole blocks. `arguments`: addresses of the kernel's
    // arguments. Throws Unavailable if the kernel's registers do not allow blocks of this size on the device.
    void launch(int threads, std::initializer_list<const void*> arguments);

private:
    struct Loaded {
        CUfunction function = nullptr;
        int most_threads = 0;  // max threads per block
    };

    const Loaded& loaded();

    const char* ptx_;
    const char* name_;
    std::mutex mutex_;
    std::map<CUcontext, Loaded> loaded_;
};

// Returns the resources of the kernels that `load` loads in the calling thread.
std::vector<KernelResources> loaded_by(const std::function<void()>& load);

// Sets the threads per block for later launches of the calling thread; 0: job::block_threads.
void use_blocks_of(int threads);

// Waits for all launches on the calling thread's device.
void wait();

}  // namespace mandelmarch::cuda
