// SPDX-License-Identifier: Apache-2.0
#include "core/image/averaged.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace mandelmarch {
namespace {

struct SampleSum {
    std::array<unsigned, 3> bytes{};
    PixelValue value{.depth = std::numeric_limits<double>::infinity()};
    std::int64_t steps = 0;
    std::int64_t iterations = 0;

    void add(const Image& samples, std::size_t at)
    {
        for (std::size_t c = 0; c < bytes.size(); ++c) bytes.at(c) += samples.bytes()[3 * at + c];
        if (!samples.has_values()) return;
        const PixelValue& sample = samples.values()[at];
        value.red += sample.red;
        value.green += sample.green;
        value.blue += sample.blue;
        value.depth = std::min(value.depth, sample.depth);
        steps += sample.steps;
        iterations += sample.iterations;
    }
};

}  // namespace

Image averaged(const Image& samples, int side)
{
    Image image(samples.width() / side, samples.height() / side, samples.layers());
    const auto count = static_cast<unsigned>(side * side);
    std::size_t to = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x, ++to) {
            SampleSum sum;
            for (int j = 0; j < side; ++j) {
                const std::size_t row = Image::pixels(samples.width(), y * side + j);
                for (int i = 0; i < side; ++i) sum.add(samples, row + static_cast<std::size_t>(x * side + i));
            }
            for (std::size_t c = 0; c < sum.bytes.size(); ++c) {
                image.bytes()[3 * to + c] = static_cast<std::uint8_t>((sum.bytes.at(c) + count / 2) / count);
            }
            if (!image.has_values()) continue;
            for (double* c : {&sum.value.red, &sum.value.green, &sum.value.blue}) *c /= count;
            sum.value.steps = static_cast<std::int32_t>(sum.steps / count);
            sum.value.iterations = static_cast<std::int32_t>(sum.iterations / count);
            image.values()[to] = sum.value;
        }
    }
    return image;
}

}  // namespace mandelmarch
