// SPDX-License-Identifier: Apache-2.0
#include "backends/vulkan/probe.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace mandelmarch::vulkan {
namespace {

constexpr int values = 4096;    // a multiple of the group's size
constexpr int group_side = 64;  // as in probe.comp
constexpr int group_count = values / group_side;

// Numbers between 2^-20 and 2^20, every bit of the mantissa in use: SplitMix64 (Steele, Lea and Flood, 2014). An
// approximation that is off in the last bit is seen within a few dozen of them. Among them are, again and again,
// numbers whose quotients and roots lie just beside the middle of two neighbours: 1 + ulp, 2 - ulp and other neighbours
// of powers of two.
template <class Real>
std::vector<Real> tricky_numbers(std::uint64_t seed)
{
    std::vector<Real> numbers;
    for (int i = 0; i < values; ++i) {
        seed += 0x9e3779b97f4a7c15;
        std::uint64_t bits = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9;
        bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
        bits ^= bits >> 31;
        const int exponent = static_cast<int>(bits % 40) - 20;
        const auto mantissa = static_cast<Real>(1) + std::ldexp(static_cast<Real>(bits >> 12), -52);
        const auto few_units =
            static_cast<Real>(static_cast<int>(bits >> 8 & 15) - 7) * std::numeric_limits<Real>::epsilon();
        numbers.push_back(std::ldexp(i % 3 == 0 ? 1 + few_units : mantissa, exponent));
    }
    return numbers;
}

// True if the words of probe.comp give what the host's give, in every bit.
template <class Real>
bool rounds_correctly(Gpu& gpu, Workbench& bench, const std::string& module)
{
    bench = {};
    bench.program = std::make_unique<Program>(gpu, module_named(module), 4);
    std::vector<Binding> bindings;
    bench.buffers.reserve(4);
    for (int i = 0; i < 4; ++i) {
        bench.buffers.push_back(gpu.make_buffer(values * sizeof(Real), Place::host, "a probe"));
        bindings.push_back({&bench.buffers.back(), 0, VK_WHOLE_SIZE});
    }
    const auto dividends = tricky_numbers<Real>(1);
    const auto divisors = tricky_numbers<Real>(2);
    std::memcpy(bench.buffers[0].bytes, dividends.data(), values * sizeof(Real));
    std::memcpy(bench.buffers[1].bytes, divisors.data(), values * sizeof(Real));
    bench.program->bind(bindings);
    bench.program->dispatch(gpu, {}, {}, group_count, 1);
    gpu.barrier();
    gpu.finish("dividing numbers as a probe");
    std::vector<Real> quotients(values);
    std::vector<Real> roots(values);
    std::memcpy(quotients.data(), bench.buffers[2].bytes, values * sizeof(Real));
    std::memcpy(roots.data(), bench.buffers[3].bytes, values * sizeof(Real));
    for (std::size_t i = 0; i < values; ++i) {
        if (!(quotients[i] == dividends[i] / divisors[i]) || !(roots[i] == std::sqrt(dividends[i]))) return false;
    }
    return true;
}

}  // namespace

std::string exact_modules(Gpu& gpu, Workbench& bench, Precision precision)
{
    if (precision == Precision::f64) {
        if (rounds_correctly<double>(gpu, bench, "probe_double_exact")) return "";
    } else {
        if (rounds_correctly<float>(gpu, bench, "probe_float_exact")) return "";
        if (gpu.facts().has_double && rounds_correctly<float>(gpu, bench, "probe_float_exact_pinned")) return "_pinned";
    }
    throw Unavailable(
        fmt::format("backend vulkan: {}: its {} division and square root are not exact, --mode fast may do", gpu.name(),
                    name_of(precision)));
}

}  // namespace mandelmarch::vulkan
