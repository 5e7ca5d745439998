// SPDX-License-Identifier: Apache-2.0
// A look: the colours and the light of a colouring type from 2 on, as named numbers. core/kernel/looks.h computes with
// them. The folder looks contains the built-in ones as files, and docs/looks.md explains the format.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace mandelmarch {

// An entry of a look file: a name and one or more numbers, each from `low` to `high`.
struct LookEntry {
    std::string_view name;
    std::size_t count;
    double low, high;
};

inline constexpr double brightest = 100;

// The entries, in the order of their numbers. Colours and light are linear red, green and blue.
inline constexpr std::array look_entries{
    LookEntry{"surface", 3, 0, 1},
    // A layer's colour, three weights of the orbit trap, an offset and an amount: see layered() in core/kernel/looks.h.
    LookEntry{"layer_1", 8, -brightest, brightest}, LookEntry{"layer_2", 8, -brightest, brightest},
    LookEntry{"layer_3", 8, -brightest, brightest}, LookEntry{"layer_4", 8, -brightest, brightest},
    LookEntry{"sun", 3, 0, brightest}, LookEntry{"sky_light", 3, 0, brightest},
    LookEntry{"ground_light", 3, 0, brightest}, LookEntry{"camera_light", 3, 0, brightest},
    LookEntry{"lamp", 3, 0, brightest}, LookEntry{"fill_light", 3, 0, brightest}, LookEntry{"zenith", 3, 0, brightest},
    LookEntry{"horizon", 3, 0, brightest}, LookEntry{"glow", 3, 0, brightest},
    LookEntry{"halo", 2, 0, brightest},  // of the sun: wide, narrow; multiples of the glow
    LookEntry{"horizon_glow", 1, 0, brightest}, LookEntry{"clouds", 1, 0, 1},  // cover
    LookEntry{"haze", 1, 0, 1},           // share of the haze in the colour of the farthest surfaces
    LookEntry{"exposure", 1, 0.01, 100},  // factor of all light
    LookEntry{"sun_height", 1, 0, 90},    // degrees above the horizon
    LookEntry{"sun_follows", 1, 0, 1},    // 1: the sun of a film turns with the way
};

constexpr std::size_t count_of_look_numbers()
{
    std::size_t count = 0;
    for (const LookEntry& entry : look_entries) count += entry.count;
    return count;
}

struct LookValues {
    std::array<double, count_of_look_numbers()> numbers{};

    double sun_height() const { return numbers[numbers.size() - 2]; }  // degrees
    bool sun_follows() const { return numbers.back() > 0; }
    bool operator==(const LookValues&) const = default;
};

// Parses a look file. Entries that are missing are 0; only the exposure is required. Throws InputError; the message
// begins with `name` and the line's number.
LookValues parse_look(std::string_view text, const std::string& name);

// Returns the look of a colouring type from 2 on.
const LookValues& built_in_look(int colouring);

}  // namespace mandelmarch
