// SPDX-License-Identifier: Apache-2.0
// The words of every prelude (docs/kernel-language.md) give the expected bits in exact mode, on every device, for
// numbers at which languages and devices differ: ties, zeros of both signs, NaN, infinities, powers of two and their
// neighbours, the limits of the type, and random numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include "core/render/backend.h"
#include "core/text/error.h"
#ifdef MANDELMARCH_WORDS_OPENCL
#include "backends/opencl/device.h"
#endif
#ifdef MANDELMARCH_WORDS_VULKAN
#include "backends/vulkan/probe.h"
#endif

namespace mandelmarch {
namespace {

#define MM_FAST 0
#define MM_COUNTED 1
#define MM_REGISTERS 4
#define MM_REAL double
#define MM_REAL_IS_FLOAT 0
namespace scalar64 {
#include "core/kernel/prelude/scalar.h"
#include "tests/words/part.h"
}  // namespace scalar64
namespace pack64 {
#include "core/kernel/prelude/pack.h"
#include "tests/words/part.h"
}  // namespace pack64
#undef MM_REAL
#undef MM_REAL_IS_FLOAT
#define MM_REAL float
#define MM_REAL_IS_FLOAT 1
namespace scalar32 {
#include "core/kernel/prelude/scalar.h"
#include "tests/words/part.h"
}  // namespace scalar32
namespace pack32 {
#include "core/kernel/prelude/pack.h"
#include "tests/words/part.h"
}  // namespace pack32
#undef MM_REGISTERS

// The names of the words, by their numbers in words.h. The first ones are also those of operations of C++.
constexpr std::array names{"quotient", "root",           "magnitude",   "nearest",     "exponent_of", "two_to",
                           "larger",   "smaller",        "pick, !, <=", "pick, &&, >", "any, count",  "* +",
                           "clipped",  "quick_quotient", "quick_root",  "over_root",   "natural_log", "exponential",
                           "cosine",   "sine",           "angle_of"};
constexpr int of_language = 12;
constexpr std::size_t pairs = 1024;  // a multiple of all numbers of lanes

double by_scalar(int word, double a, double b) { return scalar64::result_of(word, a, b); }
float by_scalar(int word, float a, float b) { return scalar32::result_of(word, a, b); }

template <class Real>
Real expected(int word, Real a, Real b)
{
    if (word >= of_language) return by_scalar(word, a, b);
    const Real rounded = std::nearbyint(a);
    const Real larger = a > b ? a : b;
    const Real smaller = a < b ? a : b;
    const Real all[of_language] = {a / b,  std::sqrt(a), std::fabs(a),   rounded, std::logb(a), std::exp2(rounded),
                                   larger, smaller,      a <= b ? b : a, larger,  smaller,      a * b + a};
    return all[word];
}

// Returns true if the contract of the word covers these operands. Devices may flush subnormal numbers to 0.
template <class Real>
bool covered(int word, Real a, Real b)
{
    const std::string_view name = names.at(static_cast<std::size_t>(word));
    const auto subnormal = [](Real x) { return std::fpclassify(x) == FP_SUBNORMAL; };
    if (subnormal(a) || subnormal(b) || subnormal(expected(word, a, b))) return false;
    constexpr int most = std::numeric_limits<Real>::max_exponent - 2;  // of an exponent whose negative is one, too
    if (name == "exponent_of") return std::isnormal(a);
    if (name == "natural_log") return std::isnormal(a) && std::ilogb(a) <= most;
    if (name == "two_to") return std::abs(a) <= Real(most);
    if (name == "clipped" || name == "exponential") return !std::isnan(a);
    if (name == "cosine" || name == "sine") return std::abs(a) < 1000;
    if (name == "angle_of") return std::isfinite(a) && std::isfinite(b);
    return word < of_language || (std::isnormal(a) && a > 0 && std::isnormal(b) && b > 0);
}

template <class Real>
class Words : public testing::Test {
protected:
    using Numbers = std::vector<Real>;
    Numbers a, b;

    Words()
    {
        using Limits = std::numeric_limits<Real>;
        const Real whole = std::ldexp(Real(1), Limits::digits - 1);  // from here on all numbers are integers
        Numbers all{0, 0.5, 1.5, 2.5, 3.5, 4.5, 6.5, 100.5, whole - Real(0.5), whole + 1, Limits::min(), Limits::max()};
        all.insert(all.end(), {Limits::infinity(), Limits::quiet_NaN()});
        for (const int exponent : {-125, -60, -24, -2, -1, 0, 1, 2, 7, 22, 23, 52, 60, 125}) {
            const Real power = std::ldexp(Real(1), exponent);
            all.insert(all.end(), {std::nextafter(power, Real(0)), power, std::nextafter(power, Limits::max())});
        }
        std::mt19937 random(1);
        while (all.size() < 120)
            all.push_back(std::ldexp(Real(1) + Real(random()) / Real(1LL << 32), int(random() % 40) - 20));
        for (std::size_t i = 0; i < pairs; ++i) {
            a.push_back((i / all.size() % 2 == 0 ? 1 : -1) * all[i % all.size()]);
            b.push_back(i % 7 == 0 ? a.back() : i % 7 == 1 ? -a.back() : all[random() % all.size()]);
        }
    }

    // Returns an example for each word that has other bits than expected. answer(word, i): the result for the pair i.
    template <class Answer>
    std::vector<std::string> different(const Answer& answer) const
    {
        std::vector<std::string> found;
        for (int word = 0; word < static_cast<int>(names.size()); ++word) {
            for (std::size_t i = 0; i < pairs; ++i) {
                const Real got = answer(word, i);
                const Real right = expected(word, a[i], b[i]);
                const bool same = std::isnan(right) ? std::isnan(got) : std::memcmp(&got, &right, sizeof(Real)) == 0;
                if (same || !covered(word, a[i], b[i])) continue;
                found.push_back(fmt::format("{} of {:.17g} and {:.17g}: {:.17g}, expected {:.17g}",
                                            names.at(static_cast<std::size_t>(word)), a[i], b[i], got, right));
                break;
            }
        }
        return found;
    }
    std::vector<std::string> different(const Numbers& all) const
    {
        return different([&](int word, std::size_t i) { return all.at(static_cast<std::size_t>(word) * pairs + i); });
    }
};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(Words, Precisions);

const std::vector<std::string> none;

TYPED_TEST(Words, OfTheScalarPreludeHaveTheirBits)
{
    EXPECT_EQ(this->different([&](int word, std::size_t i) { return by_scalar(word, this->a[i], this->b[i]); }), none);
}

// Negative control: ties away from zero, and a max and a min that treat NaN and zeros as others do.
TYPED_TEST(Words, FaultsAreFound)
{
    const auto wrong = [&](int word, std::size_t i) {
        const TypeParam x = this->a[i];
        const TypeParam y = this->b[i];
        const std::string_view name = names.at(static_cast<std::size_t>(word));
        if (name == "nearest") return std::round(x);
        if (name == "larger") return y > x ? y : x;
        return name == "smaller" ? (y < x ? y : x) : by_scalar(word, x, y);
    };
    EXPECT_EQ(this->different(wrong).size(), 3U);
}

TYPED_TEST(Words, OfPacksHaveTheirBits)
{
    std::vector<TypeParam> answers(names.size() * pairs);
    const auto compute = [&](auto real, auto result_of, std::size_t lanes) {
        for (std::size_t at = 0; at < answers.size(); at += lanes) {
            decltype(real) x;
            decltype(real) y;
            std::memcpy(&x, this->a.data() + at % pairs, sizeof(x));
            std::memcpy(&y, this->b.data() + at % pairs, sizeof(y));
            const auto z = result_of(static_cast<int>(at / pairs), x, y);
            std::memcpy(answers.data() + at, &z, sizeof(z));
        }
    };
    if constexpr (sizeof(TypeParam) == 4) {
        compute(
            pack32::real(), [](auto... of) { return pack32::result_of(of...); }, pack32::pack_lanes);
    } else {
        compute(
            pack64::real(), [](auto... of) { return pack64::result_of(of...); }, pack64::pack_lanes);
    }
    EXPECT_EQ(this->different(answers), none);
}

#ifdef MANDELMARCH_WORDS_OPENCL
constexpr const char* text =
#include "words.txt"
    ;

TYPED_TEST(Words, OfOpenclHaveTheirBits)
try {
    if (opencl::all_devices().empty()) throw Unavailable("no OpenCL device");
    for (const cl::Device& device : opencl::all_devices()) {
        for (const int lanes : {1, 4, 0}) {
            const auto build = opencl::build_for(device, {.precision = precision_of<TypeParam>, .simd_width = lanes});
            const cl::Context context(device);
            const cl::CommandQueue queue(context, device);
            cl::Program program(context, text);
            program.build({device}, build.options.c_str());
            cl::Kernel kernel(program, "answer");
            std::vector<TypeParam> answers(names.size() * pairs);
            std::vector<cl::Buffer> buffers;
            for (std::vector<TypeParam>* of : {&this->a, &this->b, &answers}) {
                buffers.emplace_back(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, of->size() * sizeof(TypeParam),
                                     of->data());
                kernel.setArg(static_cast<cl_uint>(buffers.size() - 1), buffers.back());
            }
            kernel.setArg(3, static_cast<int>(names.size()));
            queue.enqueueNDRangeKernel(kernel, cl::NullRange,
                                       cl::NDRange(pairs / static_cast<std::size_t>(build.lanes)));
            queue.enqueueReadBuffer(buffers.back(), CL_TRUE, 0, answers.size() * sizeof(TypeParam), answers.data());
            EXPECT_EQ(this->different(answers), none)
                << device.getInfo<CL_DEVICE_NAME>() << ", " << build.lanes << " lanes";
        }
    }
} catch (const Unavailable& why) {
    GTEST_SKIP() << why.what();
}
#endif

#ifdef MANDELMARCH_WORDS_VULKAN
TYPED_TEST(Words, OfVulkanHaveTheirBits)
try {
    const vulkan::Instance instance;
    for (const auto& physical : instance.devices()) {
        vulkan::Gpu gpu(physical, precision_of<TypeParam>);
        vulkan::Workbench bench;
        const std::string ending = vulkan::exact_modules(gpu, bench, precision_of<TypeParam>);
        const auto file =
            fmt::format("{}/words_{}_exact{}.spv", MANDELMARCH_WORDS_VULKAN, name_of(precision_of<TypeParam>), ending);
        std::ifstream stream(file, std::ios::binary);
        const std::string code(std::istreambuf_iterator<char>(stream), {});
        std::vector<std::uint32_t> module(code.size() / 4);
        std::memcpy(module.data(), code.data(), code.size());
        bench = {};
        bench.program = std::make_unique<vulkan::Program>(gpu, module, 3);
        std::vector<TypeParam> answers(names.size() * pairs);
        std::vector<vulkan::Binding> bindings;
        bench.buffers.reserve(3);
        for (const std::vector<TypeParam>* of : {&this->a, &this->b, &answers}) {
            bench.buffers.push_back(gpu.make_buffer(of->size() * sizeof(TypeParam), vulkan::Place::host, "words"));
            std::memcpy(bench.buffers.back().bytes, of->data(), of->size() * sizeof(TypeParam));
            bindings.push_back({&bench.buffers.back(), 0, VK_WHOLE_SIZE});
        }
        bench.program->bind(bindings);
        bench.program->dispatch(gpu, {}, {}, pairs / 64, 1);
        gpu.barrier();
        gpu.finish("computing words");
        std::memcpy(answers.data(), bench.buffers[2].bytes, answers.size() * sizeof(TypeParam));
        EXPECT_EQ(this->different(answers), none) << gpu.name();
    }
} catch (const Unavailable& why) {
    GTEST_SKIP() << why.what();
}
#endif

}  // namespace
}  // namespace mandelmarch
