// SPDX-License-Identifier: Apache-2.0
// A look: the colours and the light of a colouring, as named numbers. core/kernel/looks.h computes with them. Each file
// NAME.look of the folder scenes becomes a look of that name; docs/looks.md explains the format.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace mandelmarch {

struct LookRange {
    double low, high;
};

// Ranges of the numbers of entries. Colours and lights are linear red, green and blue.
namespace look_ranges {
inline constexpr LookRange share{0, 1}, light{0, 100}, weight{-100, 100};
inline constexpr std::array colour{share, share, share};
inline constexpr std::array lights{light, light, light};
inline constexpr std::array layer{share, share, share, weight, weight, weight, weight, share};
inline constexpr std::array factor{light};
inline constexpr std::array two_factors{light, light};
inline constexpr std::array one_share{share};
inline constexpr std::array exposure{LookRange{0.01, 100}};
inline constexpr std::array height{LookRange{0, 90}};
inline constexpr std::array azimuth{LookRange{0, 360}};
}  // namespace look_ranges

// An entry of a look file: a name and one or more numbers.
struct LookEntry {
    std::string_view name;
    std::span<const LookRange> ranges;  // of each number
};

// The entries, in the order of their numbers. The kernel receives all but the last two.
inline constexpr std::array look_entries{
    LookEntry{"surface", look_ranges::colour},
    // A layer's colour, three weights of the orbit trap, an offset and an amount: see layered() in core/kernel/looks.h.
    LookEntry{"layer_1", look_ranges::layer}, LookEntry{"layer_2", look_ranges::layer},
    LookEntry{"layer_3", look_ranges::layer}, LookEntry{"layer_4", look_ranges::layer},
    LookEntry{"sun", look_ranges::lights}, LookEntry{"sky_light", look_ranges::lights},
    LookEntry{"ground_light", look_ranges::lights}, LookEntry{"camera_light", look_ranges::lights},
    LookEntry{"lamp", look_ranges::lights}, LookEntry{"fill_light", look_ranges::lights},
    LookEntry{"zenith", look_ranges::lights}, LookEntry{"horizon", look_ranges::lights},
    LookEntry{"glow", look_ranges::lights},
    LookEntry{"halo", look_ranges::two_factors},  // of the sun: wide, narrow; multiples of the glow
    LookEntry{"horizon_glow", look_ranges::factor}, LookEntry{"clouds", look_ranges::one_share},  // cover
    LookEntry{"haze", look_ranges::one_share},  // share of the haze in the colour of the farthest surfaces
    LookEntry{"exposure", look_ranges::exposure},
    LookEntry{"sun_height", look_ranges::height},    // degrees above the horizon
    LookEntry{"sun_azimuth", look_ranges::azimuth},  // degrees to the right of the direction of view; 0: not given
};

// Returns the place of an entry's first number. For a name that is no entry, returns the count of all numbers.
constexpr std::size_t place_in_look(std::string_view name)
{
    std::size_t place = 0;
    for (const LookEntry& entry : look_entries) {
        if (entry.name == name) break;
        place += entry.ranges.size();
    }
    return place;
}
inline constexpr std::size_t kernel_look_numbers = place_in_look("sun_height");

struct LookValues {
    std::array<double, place_in_look("")> numbers{};

    double sun_height() const { return numbers[place_in_look("sun_height")]; }    // degrees
    double sun_azimuth() const { return numbers[place_in_look("sun_azimuth")]; }  // degrees; 0: not given
    bool operator==(const LookValues&) const = default;
};

// Parses a look file. Entries that are missing are 0; only the exposure is required. Throws InputError; the message
// begins with `name` and, if a line is wrong, the line's number.
LookValues parse_look(std::string_view text, const std::string& name);

// Returns the look of the file scenes/NAME.look; nullptr if there was no such file when the program was built.
const LookValues* look_named(std::string_view name);

}  // namespace mandelmarch
