// SPDX-License-Identifier: Apache-2.0
// NVIDIA's and AMD's driver libraries. They are loaded on first use, so that programs also run without them. The
// backends openacc and omptarget use NVIDIA's for queries that their run-time libraries lack.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace mandelmarch::job {

// A driver's functions. Both libraries have each of them, with the same arguments, under two names (driver.cpp). They
// are declared here, because a build may have neither cuda.h (CUDA) nor hip_runtime_api.h (HIP, ROCm 5.0 to 6.2), from
// which the types and numbers were taken. Handles are pointers. The functions return 0, or the number of an error.
struct Driver {
    bool is_amd = false;
    const char* model = "";   // the backend
    const char* vendor = "";  // the maker of the GPUs
    const char* api = "";
    std::array<const char*, 3> libraries{};  // names, tried in this order; may be null
    std::array<int, 2> version_units{};      // divisors that give the version's major and minor number
    std::array<int, 3> refusals{};           // errors of load() if the image does not suit the driver or the GPU
    int multiprocessors = 0;                 // numbers of the devices' attributes: multiprocessors,
    int resident_threads = 0;                // resident threads of a multiprocessor,
    int watchdog = 0;                        // and whether a watchdog ends long kernels

    int devices = 0;
    std::string missing{};  // the reason why no devices are available

    int (*start)(unsigned flags) = nullptr;
    int (*version)(int* version) = nullptr;
    int (*count)(int* devices) = nullptr;
    int (*device)(int* device, int index) = nullptr;
    int (*name)(char* name, int size, int device) = nullptr;
    int (*attribute)(int* value, int attribute, int device) = nullptr;
    int (*open)(void** context, int device) = nullptr;
    int (*use)(void* context) = nullptr;
    int (*in_use)(void** context) = nullptr;
    int (*wait)() = nullptr;
    int (*load)(void** module, const void* image) = nullptr;
    int (*find)(void** kernel, void* module, const char* name) = nullptr;
    int (*resource)(int* value, int attribute, void* kernel) = nullptr;
    int (*launch)(void* kernel, unsigned grid_x, unsigned grid_y, unsigned grid_z, unsigned block_x, unsigned block_y,
                  unsigned block_z, unsigned shared_bytes, void* stream, void** arguments, void** extra) = nullptr;
    int (*memory)(std::size_t* free, std::size_t* total) = nullptr;
    int (*allocate)(void** address, std::size_t bytes) = nullptr;
    int (*release)(void* address) = nullptr;
    int (*allocate_staging)(void** address, std::size_t bytes, unsigned flags) = nullptr;
    int (*release_staging)(void* address) = nullptr;
    int (*lock)(void* address, std::size_t bytes, unsigned flags) = nullptr;
    int (*unlock)(void* address) = nullptr;
    int (*upload)(void* to, const void* from, std::size_t bytes) = nullptr;
    int (*read_back)(void* to, const void* from, std::size_t bytes) = nullptr;
    int (*make_stream)(void** stream, unsigned flags) = nullptr;
    int (*make_event)(void** event, unsigned flags) = nullptr;
    int (*record)(void* event, void* stream) = nullptr;
    int (*wait_for_event)(void* event) = nullptr;
    int (*elapsed)(float* milliseconds, void* first, void* last) = nullptr;
    void (*error_text)() = nullptr;  // the only function whose arguments differ
};

// Attributes of kernels, and an error: the same numbers in both libraries.
inline constexpr int most_threads_of_block = 0;
inline constexpr int bytes_of_stack = 3;
inline constexpr int number_of_registers = 4;
inline constexpr int out_of_memory = 2;

const Driver& nvidia_driver();
const Driver& amd_driver();

// Throws Error with `what`, the failed action, unless the result is 0.
void check(const Driver& driver, int result, const char* what);

// Returns the version, as in "CUDA 13.0".
std::string version_of(const Driver& driver);

// Runs `launch`, which launches kernels in the default stream of the calling thread's GPU, then `wait`, which waits for
// them and throws Error if one has failed; empty: the launch waits itself. Returns the kernels' seconds, measured by
// events on the GPU; if the driver is missing or has no events, by the host's clock.
double seconds_on_gpu(const Driver& driver, const std::function<void()>& launch,
                      const std::function<void()>& wait = {});

// Locks the pages of host memory. The calling thread's GPU then writes to it directly; otherwise the driver copies
// every byte once more. Returns the lock; null if the thread does not use a GPU of this driver, or if the driver
// refuses.
std::shared_ptr<void> locked(const Driver& driver, std::span<std::uint8_t> memory);

// The size of a GPU. Members are 0 if the driver is missing or does not know them.
struct GpuSize {
    int capability = 0;        // compute capability of an NVIDIA GPU, times ten
    int multiprocessors = 0;   // their number
    int resident_threads = 0;  // max number of threads on the GPU at once; also 0 if a watchdog ends long kernels
};
GpuSize size_of(const Driver& driver, int index);

}  // namespace mandelmarch::job
