// SPDX-License-Identifier: Apache-2.0
// Modifies SPIR-V modules to simulate devices that do not compute as IEEE 754 requires.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace mandelmarch {

using Words = std::vector<std::uint32_t>;

// Makes copies of a SPIR-V module in which some instructions are replaced by others. Opcodes are from the SPIR-V
// specification, section 3.49.
class Rewritten {
public:
    explicit Rewritten(const Words& words) : from_(words) {}

    // Returns the module with each division of floating-point numbers of `bits` bits replaced by a multiplication.
    Words without_division(std::uint32_t bits) const
    {
        Words words = from_;
        std::uint32_t type = 0;
        for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
            const std::uint32_t opcode = words[at] & 0xffff;
            if (opcode == type_float && words[at + 2] == bits) type = words[at + 1];
            if (opcode == divide && words[at + 1] == type) words[at] = (words[at] & 0xffff0000) | multiply;
        }
        return words;
    }

    // Returns the module with every result of a float division or square root multiplied by 1 + 2^-23.
    Words off_by_a_unit()
    {
        return rewritten([&](std::size_t at, std::uint32_t opcode) {
            const bool is_root = opcode == ext_inst && from_[at + 4] == sqrt;
            if ((opcode != divide && !is_root) || from_[at + 1] != float_type_) return false;
            Words first = instruction(at);
            const std::uint32_t result = first[2];
            first[2] = fresh();
            add(first);
            add({5U << 16 | multiply, float_type_, result, first[2], unit_more_});
            return true;
        });
    }

    // Returns the module with every addition of a float product computed in double and rounded once.
    Words contracted()
    {
        return rewritten([&](std::size_t at, std::uint32_t opcode) {
            if (opcode == multiply && from_[at + 1] == float_type_) {
                products_[from_[at + 2]] = {from_[at + 3], from_[at + 4]};
            }
            if (opcode != sum || from_[at + 1] != float_type_) return false;
            for (const std::size_t side : {3U, 4U}) {
                const auto product = products_.find(from_[at + side]);
                if (product == products_.end()) continue;
                const std::uint32_t a = widened(product->second.first);
                const std::uint32_t b = widened(product->second.second);
                const std::uint32_t c = widened(from_[at + 7 - side]);
                const std::uint32_t exact = fresh();
                const std::uint32_t total = fresh();
                add({5U << 16 | multiply, double_type_, exact, a, b});
                add({5U << 16 | sum, double_type_, total, exact, c});
                add({4U << 16 | convert, float_type_, from_[at + 2], total});
                return true;
            }
            return false;
        });
    }

private:
    static constexpr std::uint32_t ext_inst = 12, capability = 17, type_float = 22, constant = 43, convert = 115;
    static constexpr std::uint32_t sum = 129, multiply = 133, divide = 136;
    static constexpr std::uint32_t sqrt = 31;     // of the instruction set GLSL.std.450
    static constexpr std::uint32_t float64 = 10;  // the capability for double

    // Replaces instructions by those that change() adds. Does not change a module with double, because it would declare
    // that type a second time.
    template <class Change>
    Words rewritten(Change change)
    {
        const std::array with_double{2U << 16 | capability, float64};
        if (!std::ranges::search(from_, with_double).empty()) return from_;
        to_.assign(from_.begin(), from_.begin() + 5);
        add({2U << 16 | capability, float64});
        for (std::size_t at = 5; at < from_.size(); at += from_[at] >> 16) {
            const std::uint32_t opcode = from_[at] & 0xffff;
            if (change(at, opcode)) continue;
            add(instruction(at));
            if (opcode != type_float || from_[at + 2] != 32) continue;
            float_type_ = from_[at + 1];
            unit_more_ = fresh();
            double_type_ = fresh();
            add({4U << 16 | constant, float_type_, unit_more_, 0x3f800001});
            add({3U << 16 | type_float, double_type_, 64});
        }
        return to_;
    }

    Words instruction(std::size_t at) const { return {&from_[at], &from_[at] + (from_[at] >> 16)}; }
    void add(const Words& words) { to_.insert(to_.end(), words.begin(), words.end()); }
    std::uint32_t fresh() { return to_[3]++; }  // returns an unused id; word 3 is the bound of the module's ids
    std::uint32_t widened(std::uint32_t number)
    {
        const std::uint32_t wide = fresh();
        add({4U << 16 | convert, double_type_, wide, number});
        return wide;
    }

    const Words& from_;
    Words to_;
    std::uint32_t float_type_ = 0, double_type_ = 0, unit_more_ = 0;
    std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> products_;  // float products and their factors
};

}  // namespace mandelmarch
