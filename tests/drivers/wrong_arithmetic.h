// SPDX-License-Identifier: Apache-2.0
// Modifies SPIR-V modules to simulate devices that do not compute as IEEE 754 requires.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace mandelmarch {

// Returns the module with each division of floating-point numbers of `bits` bits replaced by a multiplication. Opcodes
// are from the SPIR-V specification, section 3.49.
inline std::vector<std::uint32_t> without_division(std::vector<std::uint32_t> words, std::uint32_t bits)
{
    constexpr std::uint32_t type_float = 22;
    constexpr std::uint32_t multiply = 133;
    constexpr std::uint32_t divide = 136;
    std::uint32_t type = 0;
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
        const std::uint32_t opcode = words[at] & 0xffff;
        if (opcode == type_float && words[at + 2] == bits) type = words[at + 1];
        if (opcode == divide && words[at + 1] == type) words[at] = (words[at] & 0xffff0000) | multiply;
    }
    return words;
}

// Makes copies of a SPIR-V module in which some instructions are replaced by others. Opcodes are from the SPIR-V
// specification, section 3.49.
class Rewritten {
public:
    explicit Rewritten(const std::vector<std::uint32_t>& words) : from_(words) {}

    // Returns the module with every result of a float division or square root multiplied by 1 + 2^-23.
    std::vector<std::uint32_t> off_by_a_unit()
    {
        if (has_double()) return from_;
        return rewritten([&](std::size_t at, std::uint32_t opcode) {
            const bool is_root = opcode == ext_inst && from_[at + 4] == sqrt;
            if ((opcode != divide && !is_root) || from_[at + 1] != float_type_) return false;
            std::vector<std::uint32_t> first(from_.begin() + static_cast<std::ptrdiff_t>(at),
                                             from_.begin() + static_cast<std::ptrdiff_t>(at + (from_[at] >> 16)));
            const std::uint32_t result = first[2];
            first[2] = fresh();
            add(first);
            add({5U << 16 | multiply, float_type_, result, first[2], unit_more_});
            return true;
        });
    }

    // Returns the module with every addition of a float product computed in double and rounded once.
    std::vector<std::uint32_t> contracted()
    {
        if (has_double()) return from_;
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

    template <class Change>
    std::vector<std::uint32_t> rewritten(Change change)
    {
        to_.assign(from_.begin(), from_.begin() + 5);
        add({2U << 16 | capability, float64});
        for (std::size_t at = 5; at < from_.size(); at += from_[at] >> 16) {
            const std::uint32_t opcode = from_[at] & 0xffff;
            if (change(at, opcode)) continue;
            add({from_.begin() + static_cast<std::ptrdiff_t>(at),
                 from_.begin() + static_cast<std::ptrdiff_t>(at + (from_[at] >> 16))});
            if (opcode != type_float || from_[at + 2] != 32) continue;
            float_type_ = from_[at + 1];
            unit_more_ = fresh();
            double_type_ = fresh();
            add({4U << 16 | constant, float_type_, unit_more_, 0x3f800001});
            add({3U << 16 | type_float, double_type_, 64});
        }
        return to_;
    }

    // Returns true if the module declares a 64-bit type. Such modules are not changed, because the changes would
    // declare that type a second time.
    bool has_double() const
    {
        for (std::size_t at = 5; at < from_.size(); at += from_[at] >> 16) {
            if ((from_[at] & 0xffff) == type_float && from_[at + 2] == 64) return true;
        }
        return false;
    }

    void add(const std::vector<std::uint32_t>& words) { to_.insert(to_.end(), words.begin(), words.end()); }
    std::uint32_t fresh() { return to_[3]++; }  // returns an unused id; word 3 is the bound of the module's ids
    std::uint32_t widened(std::uint32_t number)
    {
        const std::uint32_t wide = fresh();
        add({4U << 16 | convert, double_type_, wide, number});
        return wide;
    }

    const std::vector<std::uint32_t>& from_;
    std::vector<std::uint32_t> to_;
    std::uint32_t float_type_ = 0, double_type_ = 0, unit_more_ = 0;
    std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> products_;  // float products and their factors
};

}  // namespace mandelmarch
