// SPDX-License-Identifier: Apache-2.0
#include "backends/vulkan/probe.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>

namespace mandelmarch::vulkan {
namespace {

constexpr int values = 4096;    // a multiple of the group's size
constexpr int group_side = 64;  // as in probe.comp
constexpr int group_count = values / group_side;

// Returns numbers between 2^-20 and 2^20 that use every bit of the mantissa: SplitMix64 (Steele, Lea and Flood, 2014).
// A few dozen of them reveal an approximation with an error in the last bit. Some are near powers of two (1 + ulp, 2 -
// ulp and other neighbours), so that their quotients and roots lie close to the midpoint of two neighbours.
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

// First difference between probe.comp and the host.
enum class Found { nothing, quotients, contraction };

template <class Real>
Found probed(Gpu& gpu, Workbench& bench, const std::string& module)
{
    constexpr int canaries = 5;
    constexpr std::array<std::size_t, 6> lengths{values, values, values, values, values, canaries * values};
    bench = {};
    bench.program = std::make_unique<Program>(gpu, module_named(module), static_cast<int>(lengths.size()));
    std::vector<Binding> bindings;
    bench.buffers.reserve(lengths.size());
    for (const std::size_t length : lengths) {
        bench.buffers.push_back(gpu.make_buffer(length * sizeof(Real), Place::host, "a probe"));
        bindings.push_back({&bench.buffers.back(), 0, VK_WHOLE_SIZE});
    }
    const auto dividends = tricky_numbers<Real>(1);
    const auto divisors = tricky_numbers<Real>(2);
    // The negated rounded products: a fused addition then returns the rounding error of the product.
    std::vector<Real> addends;
    for (std::size_t i = 0; i < values; ++i) addends.push_back(-(dividends[i] * divisors[i]));
    for (const auto& [at, numbers] : {std::pair(0, &dividends), {1, &divisors}, {2, &addends}}) {
        std::memcpy(bench.buffers[static_cast<std::size_t>(at)].bytes, numbers->data(), values * sizeof(Real));
    }
    bench.program->bind(bindings);
    bench.program->dispatch(gpu, {}, {}, group_count, 1);
    gpu.barrier();
    gpu.finish("computing a probe");
    const auto answers = [&](std::size_t at) {
        std::vector<Real> numbers(lengths.at(at));
        std::memcpy(numbers.data(), bench.buffers[at].bytes, numbers.size() * sizeof(Real));
        return numbers;
    };
    const auto quotients = answers(3);
    const auto roots = answers(4);
    const auto sums = answers(5);
    Found found = Found::nothing;
    for (std::size_t i = 0; i < values; ++i) {
        const Real a = dividends[i];
        const Real b = divisors[i];
        const Real c = addends[i];
        const std::array<Real, canaries> expected{a * b + c, c - a * b, b * a + c, a * a + b * b + c * c,
                                                  ((a * b + c) * a + b) * c + a};
        for (std::size_t canary = 0; canary < canaries; ++canary) {
            if (!(sums[canary * values + i] == expected[canary])) return Found::contraction;
        }
        if (!(quotients[i] == a / b) || !(roots[i] == std::sqrt(a))) found = Found::quotients;
    }
    return found;
}

}  // namespace

std::string exact_modules(Gpu& gpu, Workbench& bench, Precision precision)
{
    const bool is_float = precision == Precision::f32;
    std::vector<std::string> endings{""};
    if (is_float) endings.insert(endings.end(), {"_corrected", "_pinned"});
    for (const std::string& ending : endings) {
        if (ending == "_pinned" && !gpu.info().has_double) continue;
        const std::string module = fmt::format("probe_{}_exact{}", name_of(precision), ending);
        switch (is_float ? probed<float>(gpu, bench, module) : probed<double>(gpu, bench, module)) {
            case Found::nothing: return ending;
            case Found::quotients: break;
            case Found::contraction:
                throw Unavailable(
                    fmt::format("backend vulkan: {}: it fuses products and sums of {} that are to be rounded one by "
                                "one, --mode fast may do",
                                gpu.name(), name_of(precision)));
        }
    }
    throw Unavailable(
        fmt::format("backend vulkan: {}: its {} division and square root are not exact, --mode fast may do", gpu.name(),
                    name_of(precision)));
}

}  // namespace mandelmarch::vulkan
