// SPDX-License-Identifier: Apache-2.0
// Loads and launches kernels that are embedded in the program: of cuda, as PTX and machine code; of hip, as code
// objects. Each of the two backends compiles this folder with its own values of the macros that cmake/Models.cmake
// defines.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <mutex>
#include <vector>

#include "core/gpu/driver.h"
#include "core/models/task.h"
#include "core/render/backend.h"

// Directives of the assembler for the bytes of an image. cuda: the fat binary of nvcc. hip: a bundle of code
// objects, as clang-offload-bundler makes it (Clang's documentation, "Bundled Code Object Layout"). It begins with the
// number of objects. Then it has the place, the size and the name of an object for the host, which is empty, and of one
// for each GPU. The objects follow.
#ifdef MANDELMARCH_GPUS
#define MM_FOR_GPUS(directives) ".irp gpu, " MANDELMARCH_GPUS "\n" directives ".endr\n"
#define MM_BYTES(name, file) \
    ".ascii \"__CLANG_OFFLOAD_BUNDLE__\"\n.set .Lobjects, 1\n" MM_FOR_GPUS(".set .Lobjects, .Lobjects + 1\n")         \
    ".quad .Lobjects, 4096, 0, 30\n.ascii \"host-x86_64-unknown-linux-gnu-\"\n"                                       \
    MM_FOR_GPUS(".quad .L" name "\\gpu - " name ", .Lend" name "\\gpu - .L" name "\\gpu, 2f - 1f\n"                   \
                "1: .ascii \"hipv4-amdgcn-amd-amdhsa--\\gpu\"\n2:\n")                                                 \
    MM_FOR_GPUS(".balign 4096\n.L" name "\\gpu: .incbin \"" file ".\\gpu\"\n.Lend" name "\\gpu:\n")
#else
#define MM_BYTES(name, file) ".incbin \"" file ".fatbin\"\n"
#endif

// Embeds an image of kernels as an array with this name.
#define MM_IMAGE(name, file)                                                              \
    extern "C" {                                                                          \
    extern const char name[] __attribute__((visibility("hidden")));                       \
    }                                                                                     \
    asm(".pushsection .rodata\n.balign 4096\n.globl " #name "\n.hidden " #name "\n" #name \
        ":\n" MM_BYTES(#name, file) ".popsection\n");

namespace mandelmarch::MM_MODEL {

inline const job::Driver& driver() { return job::MM_DRIVER(); }
inline void check(int result, const char* what) { job::check(driver(), result, what); }

// A kernel, loaded once for each device that uses it.
class Module {
public:
    Module(const char* image, const char* name) : image_(image), name_(name) {}

    // Loads the kernel on the calling thread's device. NVIDIA's driver translates the PTX for that device, unless the
    // image has its machine code. Throws Unavailable if the image does not suit the driver or the device.
    void load() { static_cast<void>(loaded()); }
    // Launches at least `threads` threads, rounded up to whole blocks. `arguments`: addresses of the kernel's
    // arguments. Launches in different streams may run at the same time. Stream 0 is the default stream, in which a
    // launch or a copy waits for all streams.
    void launch(int threads, std::initializer_list<const void*> arguments, std::size_t stream = 0);

private:
    void* loaded();

    const char* image_;
    const char* name_;
    std::mutex mutex_;
    std::map<void*, void*> loaded_;  // by context
};

// Returns the resources of the kernels that `load` loads in the calling thread.
std::vector<KernelResources> loaded_by(const std::function<void()>& load);

// Waits for all launches on the calling thread's device.
void wait();

}  // namespace mandelmarch::MM_MODEL
