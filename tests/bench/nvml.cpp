// SPDX-License-Identifier: Apache-2.0
// A stand-in for NVIDIA's libnvidia-ml: one GPU, which has used 2 J more at each reading of its energy. The values of
// the readings differ, so that a test notices if one is taken for another.
#include <cstdio>

extern "C" {

int nvmlInit_v2() { return 0; }
int nvmlShutdown() { return 0; }

int nvmlDeviceGetCount_v2(unsigned* count)
{
    *count = 1;
    return 0;
}

int nvmlDeviceGetHandleByIndex_v2(unsigned /*index*/, void** device)
{
    *device = device;
    return 0;
}

int nvmlDeviceGetName(void* /*device*/, char* name, unsigned length)
{
    std::snprintf(name, length, "stand-in");
    return 0;
}

int nvmlDeviceGetPowerUsage(void* /*device*/, unsigned* milliwatts)
{
    *milliwatts = 141'873;
    return 0;
}

int nvmlDeviceGetClockInfo(void* /*device*/, unsigned clock, unsigned* megahertz)
{
    *megahertz = clock == 1 ? 1755 : 2619;
    return 0;
}

int nvmlDeviceGetTotalEnergyConsumption(void* /*device*/, unsigned long long* millijoules)
{
    static unsigned long long energy = 5'000'000;
    *millijoules = energy += 2000;
    return 0;
}

int nvmlDeviceGetCurrentClocksThrottleReasons(void* /*device*/, unsigned long long* bits)
{
    *bits = 0x04;
    return 0;
}

}  // extern "C"
