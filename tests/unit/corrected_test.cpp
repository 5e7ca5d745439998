// SPDX-License-Identifier: Apache-2.0
// core/kernel/prelude/glsl_corrected.h corrects divisions and square roots on devices whose results are off by some
// units in the last place. The test compiles this header with a number type that simulates such a device.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

namespace mandelmarch {
namespace {

// Error of the simulated device's divisions and square roots, in units in the last place.
int units_off = 0;

float off(float value) { return std::bit_cast<float>(std::bit_cast<int>(value) + units_off); }

struct Number {
    float value = 0;
    Number() = default;
    Number(float v) : value(v) {}  // NOLINT(google-explicit-constructor): converts implicitly like GLSL's numbers
    Number operator-() const { return -value; }
    Number& operator+=(Number b) { return *this = value + b.value; }
    Number& operator*=(Number b) { return *this = value * b.value; }
};
Number operator-(Number a, Number b) { return a.value - b.value; }
Number operator*(Number a, Number b) { return a.value * b.value; }
Number operator/(Number a, Number b) { return off(a.value / b.value); }
bool operator<(Number a, Number b) { return a.value < b.value; }
bool operator>(Number a, Number b) { return a.value > b.value; }
bool operator>=(Number a, Number b) { return a.value >= b.value; }
Number sqrt(Number a) { return off(std::sqrt(a.value)); }
Number abs(Number a) { return std::abs(a.value); }
int abs(int a) { return a < 0 ? -a : a; }
int floatBitsToInt(Number a) { return std::bit_cast<int>(a.value); }
Number intBitsToFloat(int bits) { return std::bit_cast<float>(bits); }

#ifdef __clang__
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
#define float Number
#define real Number
#include "core/kernel/prelude/glsl_corrected.h"
#undef float
#undef real

// Generator of test values: some have random mantissas, others are next to powers of two.
class Numbers {
public:
    float next()
    {
        const int exponent = static_cast<int>(random_() % 60) - 30;
        const auto bits = static_cast<int>(random_() & 0x7fffff);
        const int few = static_cast<int>(random_() % 16);
        const int mantissa = random_() % 3 != 0 ? bits : random_() % 2 == 0 ? few : 0x7fffff - few;
        return std::ldexp(std::bit_cast<float>(0x3f800000 | mantissa), exponent);
    }

private:
    std::mt19937 random_{1};
};

// Corrects divisions and square roots of random values, and returns the number of results that differ from IEEE 754's.
int wrong()
{
    Numbers numbers;
    int found = 0;
    for (int i = 0; i < 100'000; ++i) {
        const float a = numbers.next();
        const float b = i % 2 == 0 ? numbers.next() : -numbers.next();
        found += quotient(a, b).value == a / b ? 0 : 1;
        found += root(a).value == std::sqrt(a) ? 0 : 1;
    }
    return found;
}

TEST(Corrected, QuotientsAndRootsAreThoseOfIeeeWhereTheDevicesAreUnitsOff)
{
    for (units_off = -3; units_off <= 3; ++units_off) EXPECT_EQ(wrong(), 0) << units_off << " units off";
    units_off = 0;
}

// Negative control: if the device's result is far off, the correction, a Newton step, cannot mend it.
TEST(Corrected, DeviceThatIsFarOffIsNotCorrected)
{
    units_off = 1 << 20;
    EXPECT_GT(wrong(), 0);
    units_off = 0;
}

TEST(Corrected, ZeroAndInfinityAreUnchanged)
{
    EXPECT_EQ(quotient(0.0F, 3.0F).value, 0.0F);
    EXPECT_TRUE(std::isinf(quotient(3.0F, 0.0F).value));
    EXPECT_TRUE(std::isnan(root(-1.0F).value));
    EXPECT_EQ(root(0.0F).value, 0.0F);
}

}  // namespace
}  // namespace mandelmarch
