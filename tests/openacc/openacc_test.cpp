// SPDX-License-Identifier: Apache-2.0
// OpenACC's devices are the GPUs and the host, which must not be reported as a GPU. Pictures are tested in
// tests/models.
#include <gtest/gtest.h>

#include "backends/all.h"
#include "core/base/error.h"

namespace mandelmarch {
namespace {

TEST(OpenaccDevices, TheHostIsLastAndSaysThatItIsNoGpu)
{
    const Registry registry = all_backends();
    const Backend& openacc = *registry.find("openacc");
    const std::vector<Device> devices = openacc.devices();
    ASSERT_FALSE(devices.empty());
    EXPECT_FALSE(devices.back().is_gpu);
    EXPECT_EQ(devices.back().name.find("host, one thread"), 0U);
    for (std::size_t i = 0; i + 1 < devices.size(); ++i) EXPECT_TRUE(devices[i].is_gpu);
    const int missing = static_cast<int>(devices.size());
    EXPECT_THROW(openacc.create({.device = missing}), Unavailable);
    // `auto` never selects the host through OpenACC.
    EXPECT_EQ(registry.automatic().backend->name(), devices.front().is_gpu ? "openacc" : "openmp");
}

}  // namespace
}  // namespace mandelmarch
