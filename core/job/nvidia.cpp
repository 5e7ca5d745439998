// SPDX-License-Identifier: Apache-2.0
#include "core/job/nvidia.h"

#include <dlfcn.h>

#include <map>
#include <mutex>
#include <type_traits>
#include <vector>

#include "core/base/stopwatch.h"

namespace mandelmarch::job {
namespace {

// Declarations of cuda.h, because builds without CUDA do not have that file.
using CUresult = int;
using CUdevice = int;
using CUcontext = struct CUctx_st*;
using CUevent = struct CUevent_st*;
using CUstream = struct CUstream_st*;
constexpr CUresult CUDA_SUCCESS = 0;
constexpr int CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT = 16;
constexpr int CU_DEVICE_ATTRIBUTE_KERNEL_EXEC_TIMEOUT = 17;
constexpr int CU_DEVICE_ATTRIBUTE_MAX_THREADS_PER_MULTIPROCESSOR = 39;

struct Driver {
    CUresult (*cuDeviceGet)(CUdevice*, int) = nullptr;
    CUresult (*cuDeviceGetAttribute)(int*, int, CUdevice) = nullptr;
    CUresult (*cuCtxGetCurrent)(CUcontext*) = nullptr;
    CUresult (*cuEventCreate)(CUevent*, unsigned) = nullptr;
    CUresult (*cuEventRecord)(CUevent, CUstream) = nullptr;
    CUresult (*cuEventSynchronize)(CUevent) = nullptr;
    CUresult (*cuEventElapsedTime)(float*, CUevent, CUevent) = nullptr;
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
        load(cuCtxGetCurrent, "cuCtxGetCurrent");
        load(cuEventCreate, "cuEventCreate");
        load(cuEventRecord, "cuEventRecord");
        load(cuEventSynchronize, "cuEventSynchronize");
        load(cuEventElapsedTime, "cuEventElapsedTime");
    }
};

const Driver& driver()
{
    static const Driver only;
    return only;
}

// A pair of events of a context: one is recorded before some launches, the other one after them.
struct Pair {
    CUevent first = nullptr;
    CUevent last = nullptr;
};

// The pairs that are not in use. They are never destroyed: at the end of the process their driver may already be gone.
struct Kept {
    std::mutex mutex;
    std::map<CUcontext, std::vector<Pair>> pairs;
};

Kept& kept()
{
    static Kept& only = *new Kept;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): see above
    return only;
}

// Uses a pair of events of the calling thread's context; makes one if all are in use.
class Events {
public:
    Events()
    {
        const Driver& d = driver();
        if (!d.complete || d.cuCtxGetCurrent(&context_) != CUDA_SUCCESS) return;
        const std::scoped_lock lock(kept().mutex);
        std::vector<Pair>& pairs = kept().pairs[context_];
        if (pairs.empty()) {
            made_ = d.cuEventCreate(&pair_.first, 0) == CUDA_SUCCESS && d.cuEventCreate(&pair_.last, 0) == CUDA_SUCCESS;
            return;
        }
        pair_ = pairs.back();
        pairs.pop_back();
        made_ = true;
    }
    ~Events()
    {
        if (!made_) return;
        const std::scoped_lock lock(kept().mutex);
        kept().pairs[context_].push_back(pair_);
    }
    Events(const Events&) = delete;
    Events& operator=(const Events&) = delete;

    // Record an event. Return false if it could not be created or recorded.
    bool begin() const { return made_ && driver().cuEventRecord(pair_.first, nullptr) == CUDA_SUCCESS; }
    bool end() const { return made_ && driver().cuEventRecord(pair_.last, nullptr) == CUDA_SUCCESS; }
    bool wait() const { return driver().cuEventSynchronize(pair_.last) == CUDA_SUCCESS; }
    // Sets `milliseconds` to the time between the events. Returns false unless both have occurred.
    bool between(float& milliseconds) const
    {
        return driver().cuEventElapsedTime(&milliseconds, pair_.first, pair_.last) == CUDA_SUCCESS;
    }

private:
    CUcontext context_ = nullptr;
    Pair pair_;
    bool made_ = false;
};

}  // namespace

double seconds_on_gpu(const std::function<void()>& launch, const std::function<void()>& wait)
{
    const Events events;
    const auto start = Clock::now();
    bool timed = events.begin();
    launch();
    timed = timed && events.end();
    if (wait) {
        wait();
    } else {
        timed = timed && events.wait();
    }
    const double seconds = seconds_since(start);
    float milliseconds = 0;
    return timed && events.between(milliseconds) ? 1e-3 * milliseconds : seconds;
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
