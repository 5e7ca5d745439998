// SPDX-License-Identifier: Apache-2.0
// Messages between a program and its device processes. A message contains values one after the other, with the bytes
// that they have in memory. Both processes run the same executable, so layouts and addresses of constants agree.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "core/text/error.h"

namespace mandelmarch::isolation {

class Serializer {
public:
    template <class... Values>
    explicit Serializer(const Values&... values)
    {
        (put(values), ...);
    }

    template <class... Values>
    void operator()(const Values&... values)
    {
        (put(values), ...);
    }

    const std::string& bytes() const { return bytes_; }

private:
    template <class Value>
    void put(const Value& value)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void put(const std::string& text)
    {
        put(text.size());
        bytes_ += text;
    }
    template <class Value>
    void put(const std::vector<Value>& values)
    {
        put(values.size());
        for (const Value& value : values) transfer(*this, value);
    }

    std::string bytes_;
};

// Reads the values of a message in order. Throws Error if the message ends too early.
class Deserializer {
public:
    explicit Deserializer(std::string bytes) : bytes_(std::move(bytes)) {}

    template <class... Values>
    void operator()(Values&... values)
    {
        (take(values), ...);
    }

    template <class Value>
    Value take()
    {
        Value value{};
        take(value);
        return value;
    }

private:
    // Skips `size` bytes and returns their address.
    const char* advance(std::size_t size)
    {
        if (size > bytes_.size() - at_) throw Error("a message of a device's process is too short");
        at_ += size;
        return bytes_.data() + at_ - size;
    }

    template <class Value>
    void take(Value& value)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::memcpy(&value, advance(sizeof value), sizeof value);
    }
    void take(std::string& text)
    {
        const auto size = take<std::size_t>();
        text.assign(advance(size), size);
    }
    template <class Value>
    void take(std::vector<Value>& values)
    {
        values.clear();
        for (auto left = take<std::size_t>(); left > 0; --left) transfer(*this, values.emplace_back());
    }

    std::string bytes_;
    std::size_t at_ = 0;
};

}  // namespace mandelmarch::isolation
