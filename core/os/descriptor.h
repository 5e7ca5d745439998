// SPDX-License-Identifier: Apache-2.0
// An owned file descriptor, which the destructor closes.
#pragma once

#include <unistd.h>

#include <utility>

namespace mandelmarch {

class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor()
    {
        // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): clang-tidy 14 does not see std::exchange
        if (number_ >= 0) close(number_);
    }

    int number() const { return number_; }  // -1: none

private:
    int number_ = -1;
};

}  // namespace mandelmarch
