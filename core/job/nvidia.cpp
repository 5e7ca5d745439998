// SPDX-License-Identifier: Apache-2.0
#include "core/job/nvidia.h"

#include <dlfcn.h>

#include <type_traits>

#include "core/base/stopwatch.h"

namespace mandelmarch::job {
namespace {

// Declarations of cuda.h, because builds without CUDA do not have that file.
using CUresult = int;
using CUdevice = int;
using CUevent = struct CUevent_st*;
using CUstream = struct CUstream_st*;
constexpr CUresult CUDA_SUCCESS = 0;
constexpr int CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT = 16;
constexpr int CU_DEVICE_ATTRIBUTE_KERNEL_EXEC_TIMEOUT = 17;
constexpr int CU_DEVICE_ATTRIBUTE_MAX_THREADS_PER_MULTIPROCESSOR = 39;

struct Driver {
    CUresult (*cuDeviceGet)(CUdevice*, int) = nullptr;
    CUresult (*cuDeviceGetAttribute)(int*, int, CUdevice) = nullptr;
    CUresult (*cuEventCreate)(CUevent*, unsigned) = nullptr;
    CUresult (*cuEventRecord)(CUevent, CUstream) = nullptr;
    CUresult (*cuEventSynchronize)(CUevent) = nullptr;
    CUresult (*cuEventElapsedTime)(float*, CUevent, CUevent) = nullptr;
    CUresult (*cuEventDestroy)(CUevent) = nullptr;
    bool complete = false;

    Driver()
    {
        void* library = dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr) return;
        complete = true;
        const auto load = [&](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
            complete = complete && function != nullptr;
        };
        load(cuDeviceGet, "cuDeviceGet");
        load(cuDeviceGetAttribute, "cuDeviceGetAttribute");
        load(cuEventCreate, "cuEventCreate");
        load(cuEventRecord, "cuEventRecord");
        load(cuEventSynchronize, "cuEventSynchronize");
        load(cuEventElapsedTime, "cuEventElapsedTime");
        load(cuEventDestroy, "cuEventDestroy_v2");
    }
};

const Driver& driver()
{
    static const Driver only;
    return only;
}

class Event {
public:
    Event() { made_ = driver().complete && driver().cuEventCreate(&event_, 0) == CUDA_SUCCESS; }
    ~Event()
    {
        if (made_) driver().cuEventDestroy(event_);
    }
    Event(const Event&) = delete;
    Event& operator=(const Event&) = delete;

    // Records the event. Returns false if the event could not be created or recorded.
    bool record() const { return made_ && driver().cuEventRecord(event_, nullptr) == CUDA_SUCCESS; }
    bool wait() const { return made_ && driver().cuEventSynchronize(event_) == CUDA_SUCCESS; }
    // Sets `milliseconds` to the time from `first` to this event. Returns false unless both events have occurred.
    bool since(const Event& first, float& milliseconds) const
    {
        return driver().cuEventElapsedTime(&milliseconds, first.event_, event_) == CUDA_SUCCESS;
    }

private:
    CUevent event_ = nullptr;
    bool made_ = false;
};

}  // namespace

double seconds_on_gpu(const std::function<void()>& launch)
{
    const Event first;
    const Event last;
    const auto start = Clock::now();
    const bool timed = first.record();
    launch();
    const double seconds = seconds_since(start);
    float milliseconds = 0;
    if (timed && last.record() && last.wait() && last.since(first, milliseconds)) return 1e-3 * milliseconds;
    return seconds;
}

std::int64_t pixels_per_launch(int index)
{
    CUdevice device = 0;
    int multiprocessors = 0;
    int threads = 0;
    int watched = 1;
    const auto ask = [&](int what, int& answer) {
        return driver().cuDeviceGetAttribute(&answer, what, device) == CUDA_SUCCESS;
    };
    const bool known = driver().complete && driver().cuDeviceGet(&device, index) == CUDA_SUCCESS &&
                       ask(CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT, multiprocessors) &&
                       ask(CU_DEVICE_ATTRIBUTE_MAX_THREADS_PER_MULTIPROCESSOR, threads) &&
                       ask(CU_DEVICE_ATTRIBUTE_KERNEL_EXEC_TIMEOUT, watched);
    return pixels_of_gpu(known && watched == 0 ? std::int64_t{multiprocessors} * threads : 0);
}

}  // namespace mandelmarch::job
