// SPDX-License-Identifier: Apache-2.0
// Replaces NVIDIA's driver library (libcuda.so.1), as far as gcc's OpenACC library and the cuda backend use it; with
// SIMULATED_AMD and options that rename the functions, AMD's (libamdhip64). The GPUs are simulated: they run the
// kernels of kernels.h, which ptx_to_c.py translates from PTX, one warp after the other. Device memory is host memory.
// Environment variables describe the GPUs:
//   SIMULATED_GPUS        number of GPUs (default 1)
//   SIMULATED_CAPABILITY  compute capability (default 35)
//   SIMULATED_MEMORY      free bytes (default 1 GiB)
//   SIMULATED_CLOCK       0: no events for timing
//   SIMULATED_WATCHED     1: a watchdog ends long kernels
//   SIMULATED_LOCKS       a file; each time that memory is locked or unlocked, a line is added
//   SIMULATED_REGISTERS   registers per thread of each kernel (default 100)
//   SIMULATED_FAULT       launch, lost or timeout: the first kernel fails in this way; link: gcc's kernels do not link;
//                         version: the image does not suit the driver or the GPU; lock: no memory is locked
#define _GNU_SOURCE
#include "kernels.h"

#include <stdio.h>
#include <stdlib.h>
#include <ucontext.h>

enum {
    SUCCESS = 0,
    OUT_OF_MEMORY = 2,
    DEVICE_LOST = 719,
    LAUNCH_TIMEOUT = 702,
    OUT_OF_RESOURCES = 701,
    NOT_FOUND = 500,
    NOT_PERMITTED = 800,
    NOT_SUPPORTED = 801
};

// The version, the error of an image that does not suit the driver or the GPU, and numbers of attributes.
#ifdef SIMULATED_AMD
enum { VERSION = 60241134, REFUSED = 209, WATCHDOG = 18, RESIDENT_THREADS = 57, MULTIPROCESSORS = 63 };
#else
enum { VERSION = 11040, REFUSED = 222, WATCHDOG = 17, RESIDENT_THREADS = 39, MULTIPROCESSORS = 16 };
#endif

int thread_of_launch;  // the index of the thread that runs, for kernels compiled for the host
static int pending;    // the error that the next synchronization returns
static int current = -1;
static uint64_t taken;
static struct {
    uint64_t address;
    uint64_t bytes;
} blocks[4096];
static int block_count;

static uint64_t number(const char* name, uint64_t otherwise)
{
    const char* text = getenv(name);
    return text && *text ? strtoull(text, NULL, 10) : otherwise;
}

static int has_fault(const char* name)
{
    const char* fault = getenv("SIMULATED_FAULT");
    return fault && strcmp(fault, name) == 0;
}

int cuInit(unsigned flags) { return flags == 0 ? SUCCESS : NOT_SUPPORTED; }
int cuDriverGetVersion(int* version) { return *version = VERSION, SUCCESS; }
int cuDeviceGetCount(int* count) { return *count = (int)number("SIMULATED_GPUS", 1), SUCCESS; }
int cuDeviceGet(int* device, int index) { return *device = index, SUCCESS; }
int cuDeviceGetName(char* name, int size, int device)
{
    snprintf(name, (size_t)size, "Simulated K40 number %d", device);
    return SUCCESS;
}
int cuDeviceTotalMem_v2(size_t* bytes, int device) { return *bytes = 12ull << 30, device < 0 ? NOT_FOUND : SUCCESS; }
// Attribute numbers as in cuda.h.
int cuDeviceGetAttribute(int* value, int attribute, int device)
{
    switch (attribute) {
        case 1: *value = 1024; break;    // threads per block
        case 8: *value = 49152; break;   // shared memory per block
        case 10: *value = 32; break;     // warp size
        case 12: *value = 65536; break;  // registers per block
        case MULTIPROCESSORS: *value = 15; break;
        case WATCHDOG: *value = (int)number("SIMULATED_WATCHED", 0); break;
        case RESIDENT_THREADS: *value = 2048; break;  // of a multiprocessor
        case 82: *value = 65536; break;               // registers per multiprocessor
        case 75: *value = (int)number("SIMULATED_CAPABILITY", 35) / 10; break;
        case 76: *value = (int)number("SIMULATED_CAPABILITY", 35) % 10; break;
        default: *value = 1;
    }
    return device < 0 ? NOT_FOUND : SUCCESS;
}
static const char* text_of(int error)
{
    return error == OUT_OF_MEMORY    ? "out of memory"
           : error == LAUNCH_TIMEOUT ? "the launch timed out and was terminated"
           : error == DEVICE_LOST    ? "unspecified launch failure"
                                     : "simulated error";
}
#ifdef SIMULATED_AMD
const char* cuGetErrorString(int error) { return text_of(error); }
#else
int cuGetErrorString(int error, const char** text) { return *text = text_of(error), SUCCESS; }
#endif

int cuCtxCreate_v2(void** context, unsigned flags, int device)
{
    (void)flags;
    *context = (void*)(intptr_t)(device + 1);
    return current = device, SUCCESS;
}
int cuDevicePrimaryCtxRetain(void** context, int device)
{
    *context = (void*)(intptr_t)(device + 1);
    return device < 0 ? NOT_FOUND : SUCCESS;
}
int cuCtxSetCurrent(void* context) { return current = (int)(intptr_t)context - 1, SUCCESS; }
int cuCtxDestroy_v2(void* context) { return context ? SUCCESS : NOT_FOUND; }
int cuCtxPushCurrent_v2(void* context) { return current = (int)(intptr_t)context - 1, SUCCESS; }
int cuCtxPopCurrent_v2(void** context) { return *context = (void*)(intptr_t)(current + 1), SUCCESS; }
int cuCtxGetCurrent(void** context) { return cuCtxPopCurrent_v2(context); }
int cuCtxGetDevice(int* device) { return *device = current, SUCCESS; }
int cuCtxSynchronize(void)
{
    const int error = pending;
    return pending = SUCCESS, error;
}

int cuStreamCreate(void** stream, unsigned flags) { return *stream = stream, flags > 1 ? NOT_SUPPORTED : SUCCESS; }
int cuStreamDestroy_v2(void* stream) { return stream ? SUCCESS : NOT_FOUND; }
int cuStreamSynchronize(void* stream) { return (void)stream, cuCtxSynchronize(); }
int cuStreamQuery(void* stream) { return stream ? SUCCESS : NOT_FOUND; }
int cuStreamWaitEvent(void) { return NOT_SUPPORTED; }
// Kernels run when they are launched, so the stream's work is done. A callback must not call the driver.
static int in_callback;
int cuStreamAddCallback(void* stream, void (*callback)(void*, int, void*), void* data, unsigned flags)
{
    (void)flags;
    in_callback = 1;
    callback(stream, SUCCESS, data);
    return in_callback = 0, SUCCESS;
}
// The GPU's clock. Each kernel takes a second, and nothing else takes time.
static int seconds;
int cuEventCreate(int** event, unsigned flags)
{
    if (number("SIMULATED_CLOCK", 1) == 0) return NOT_SUPPORTED;
    *event = malloc(sizeof **event);
    return **event = -1, flags == 0 ? SUCCESS : NOT_SUPPORTED;
}
int cuEventDestroy_v2(int* event) { return free(event), SUCCESS; }
int cuEventRecord(int* event, void* stream) { return (void)stream, *event = seconds, SUCCESS; }
int cuEventSynchronize(int* event) { return *event >= 0 ? SUCCESS : NOT_FOUND; }
int cuEventQuery(int* event) { return cuEventSynchronize(event); }
int cuEventElapsedTime(float* milliseconds, int* first, int* last)
{
    return *milliseconds = 1000.0f * (float)(*last - *first), *first < 0 ? NOT_FOUND : SUCCESS;
}

int cuLinkCreate_v2(unsigned count, int* options, void** values, void** state)
{
    (void)count, (void)options, (void)values;
    return *state = state, SUCCESS;
}
int cuLinkCreate(unsigned count, int* options, void** values, void** state)
{
    return cuLinkCreate_v2(count, options, values, state);
}
int cuLinkAddData_v2(void) { return SUCCESS; }
int cuLinkAddData(void) { return SUCCESS; }
int cuLinkComplete(void* state, void** binary, size_t* size)
{
    return *binary = state, *size = 1, has_fault("link") ? OUT_OF_RESOURCES : SUCCESS;
}
int cuLinkDestroy(void* state) { return (void)state, SUCCESS; }
int cuModuleLoad(void) { return NOT_SUPPORTED; }
int cuModuleLoadData(void** module, const void* image)
{
    *module = module;
#ifdef SIMULATED_AMD
    if (strncmp(image, "__CLANG_OFFLOAD_BUNDLE__", 24) != 0) return NOT_FOUND;
#endif
    return has_fault("version") ? REFUSED : image ? SUCCESS : NOT_FOUND;
}
int cuModuleUnload(void* module) { return (void)module, SUCCESS; }
int cuModuleGetGlobal_v2(uint64_t* address, size_t* bytes, void* module, const char* name)
{
    (void)module;
    for (int i = 0; variables[i].name; ++i) {
        if (strcmp(variables[i].name, name) != 0) continue;
        if (address) *address = (uint64_t)variables[i].at;
        if (bytes) *bytes = variables[i].bytes;
        return SUCCESS;
    }
    return NOT_FOUND;
}
int cuModuleGetFunction(void** function, void* module, const char* name)
{
    (void)module;
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; ++i) {
        if (strcmp(kernels[i].name, name) == 0) return *function = (void*)kernels[i].run, SUCCESS;
    }
    return NOT_FOUND;
}
static unsigned number_of_registers(void) { return (unsigned)number("SIMULATED_REGISTERS", 100); }
int cuFuncGetAttribute(int* value, int attribute, void* function)
{
    const unsigned registers = number_of_registers();
    *value = attribute == 0   ? (int)(65536 / registers / 32 * 32)
             : attribute == 4 ? (int)registers
                              : 0;  // 0: threads per block
    return function ? SUCCESS : NOT_FOUND;
}
int cuOccupancyMaxPotentialBlockSize(int* grid, int* block) { return *grid = 60, *block = 512, SUCCESS; }

int cuMemGetInfo_v2(size_t* free_bytes, size_t* total)
{
    *total = number("SIMULATED_MEMORY", 1ull << 30);
    return *free_bytes = *total - taken, SUCCESS;
}
int cuMemAlloc_v2(uint64_t* address, size_t bytes)
{
    if (taken + bytes > number("SIMULATED_MEMORY", 1ull << 30)) return OUT_OF_MEMORY;
    if (block_count == sizeof blocks / sizeof *blocks) return OUT_OF_MEMORY;
    taken += bytes;
    *address = (uint64_t)malloc(bytes);
    blocks[block_count].address = *address;
    blocks[block_count++].bytes = bytes;
    return SUCCESS;
}
static int block_of(uint64_t address)
{
    for (int i = 0; i < block_count; ++i) {
        if (address >= blocks[i].address && address < blocks[i].address + blocks[i].bytes) return i;
    }
    return -1;
}
int cuMemFree_v2(uint64_t address)
{
    const int at = block_of(address);
    if (address == 0) return SUCCESS;  // after a kernel without arguments, gcc's library frees null
    if (at < 0) return NOT_FOUND;
    taken -= blocks[at].bytes;
    blocks[at] = blocks[--block_count];
    free((void*)address);
    return SUCCESS;
}
int cuMemGetAddressRange_v2(uint64_t* begin, size_t* bytes, uint64_t address)
{
    const int at = block_of(address);
    if (in_callback) return NOT_PERMITTED;
    for (int i = 0; at < 0 && variables[i].name; ++i) {
        if (address - (uint64_t)variables[i].at >= variables[i].bytes) continue;
        *begin = (uint64_t)variables[i].at;
        *bytes = variables[i].bytes;
        return SUCCESS;
    }
    if (at < 0) return NOT_FOUND;
    if (begin) *begin = blocks[at].address;
    if (bytes) *bytes = blocks[at].bytes;
    return SUCCESS;
}
int cuMemAllocHost_v2(void** address, size_t bytes) { return *address = malloc(bytes), SUCCESS; }
int cuMemHostAlloc(void** address, size_t bytes) { return cuMemAllocHost_v2(address, bytes); }
int cuMemFreeHost(void* address) { return free(address), SUCCESS; }
static int count_lock(const char* what)
{
    const char* path = getenv("SIMULATED_LOCKS");
    FILE* file = path ? fopen(path, "a") : NULL;
    if (file) fprintf(file, "%s\n", what), fclose(file);
    return SUCCESS;
}
int cuMemHostRegister_v2(void* address, size_t bytes, unsigned flags)
{
    if (has_fault("lock") || flags) return NOT_SUPPORTED;
    ((volatile char*)address)[bytes - 1] = 0;
    return count_lock("locked");
}
int cuMemHostUnregister(volatile char* address) { return *address = 0, count_lock("unlocked"); }
int cuMemHostGetDevicePointer_v2(void) { return NOT_SUPPORTED; }
int cuMemcpy2D_v2(void) { return NOT_SUPPORTED; }
int cuMemcpy2DUnaligned_v2(void) { return NOT_SUPPORTED; }
int cuMemcpy3D_v2(void) { return NOT_SUPPORTED; }
int cuMemcpy(uint64_t to, uint64_t from, size_t bytes) { return memcpy((void*)to, (void*)from, bytes), SUCCESS; }
int cuMemcpyHtoD_v2(uint64_t to, const void* from, size_t bytes) { return cuMemcpy(to, (uint64_t)from, bytes); }
int cuMemcpyHtoD(uint64_t to, const void* from, size_t bytes) { return cuMemcpy(to, (uint64_t)from, bytes); }
int cuMemcpyDtoH_v2(void* to, uint64_t from, size_t bytes) { return cuMemcpy((uint64_t)to, from, bytes); }
int cuMemcpyDtoH(void* to, uint64_t from, size_t bytes) { return cuMemcpy((uint64_t)to, from, bytes); }
int cuMemcpyHtoDAsync_v2(uint64_t to, const void* from, size_t bytes) { return cuMemcpy(to, (uint64_t)from, bytes); }
int cuMemcpyHtoDAsync(uint64_t to, const void* from, size_t bytes) { return cuMemcpy(to, (uint64_t)from, bytes); }
int cuMemcpyDtoHAsync_v2(void* to, uint64_t from, size_t bytes) { return cuMemcpy((uint64_t)to, from, bytes); }
int cuMemcpyDtoHAsync(void* to, uint64_t from, size_t bytes) { return cuMemcpy((uint64_t)to, from, bytes); }
int cuMemcpyDtoDAsync_v2(uint64_t to, uint64_t from, size_t bytes) { return cuMemcpy(to, from, bytes); }
int cuMemcpyDtoDAsync(uint64_t to, uint64_t from, size_t bytes) { return cuMemcpy(to, from, bytes); }

// The warp that runs. Each lane has a stack of its own and runs until the warp's next common operation. It leaves its
// value there, and goes on when all lanes have left theirs. Values alternate between two arrays, because a lane may
// leave its next value before another one has read this one.
enum { LANES = 32, STACK = 1 << 20 };
static struct {
    void (*run)(uint64_t, uint32_t, uint32_t, uint32_t, uint32_t);
    uint64_t argument;
    unsigned first_thread, block_x, block, blocks;
    ucontext_t back, of[LANES];
    bool ended[LANES];
    uint32_t values[2][LANES];
    int turn[LANES];
    int lane;  // that runs
} warp;
static const uint32_t* values_of_lanes(uint32_t value)
{
    const int lane = warp.lane;
    uint32_t* values = warp.values[warp.turn[lane] ^= 1];
    values[lane] = value;
    swapcontext(&warp.of[lane], &warp.back);
    return values;
}
static uint32_t of_lane(uint32_t value, uint32_t lane) { return values_of_lanes(value)[lane % LANES]; }
static uint32_t ballot(bool on)
{
    const uint32_t* values = values_of_lanes(on);
    uint32_t lanes = 0;
    for (int i = 0; i < LANES; ++i) lanes |= values[i] << i;
    return lanes;
}
static void run_lane(void)
{
    const unsigned thread = warp.first_thread + (unsigned)warp.lane;
    thread_of_launch = (int)(warp.block * threads_of_block + thread);
    warp.run(warp.argument, thread % warp.block_x, thread / warp.block_x, warp.block, warp.blocks);
    warp.ended[warp.lane] = true;
}
static void run_warp(void)
{
    static char* stacks;
    if (!stacks) stacks = malloc(LANES * STACK);
    for (int i = 0; i < LANES; ++i) {
        getcontext(&warp.of[i]);
        warp.of[i].uc_stack.ss_sp = stacks + i * STACK;
        warp.of[i].uc_stack.ss_size = STACK;
        warp.of[i].uc_link = &warp.back;
        makecontext(&warp.of[i], run_lane, 0);
        warp.ended[i] = false;
    }
    for (bool running = true; running;) {
        running = false;
        for (warp.lane = 0; warp.lane < LANES; ++warp.lane) {
            if (warp.ended[warp.lane]) continue;
            swapcontext(&warp.back, &warp.of[warp.lane]);
            running = true;
        }
    }
}
int cuLaunchKernel(void* function, unsigned grid_x, unsigned grid_y, unsigned grid_z, unsigned block_x,
                   unsigned block_y, unsigned block_z, unsigned shared, void* stream, void** arguments, void** extra)
{
    (void)shared, (void)stream, (void)extra;
    const unsigned threads = block_x * block_y;
    if (grid_y * grid_z * block_z != 1 || threads != 128 || threads * number_of_registers() > 65536)
        return OUT_OF_RESOURCES;
    if (has_fault("launch")) return OUT_OF_RESOURCES;
    if (has_fault("timeout")) return pending = LAUNCH_TIMEOUT, SUCCESS;
    if (has_fault("lost")) return pending = DEVICE_LOST, SUCCESS;
    ++seconds;
    threads_of_block = threads;
    warp.run = (void (*)(uint64_t, uint32_t, uint32_t, uint32_t, uint32_t))function;
    warp.argument = (uint64_t)arguments[0];
    warp.block_x = block_x;
    warp.blocks = grid_x;
    for (warp.block = 0; warp.block < grid_x; ++warp.block) {
        for (warp.first_thread = 0; warp.first_thread < threads; warp.first_thread += LANES) run_warp();
    }
    return SUCCESS;
}
