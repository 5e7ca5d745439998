// SPDX-License-Identifier: Apache-2.0
// Limits of the numbers in bench's files, and the names of its enumerations.
#pragma once

#include <array>
#include <limits>

#include "bench/result/fields.h"
#include "bench/statistics/verdict.h"
#include "core/render/backend.h"

namespace mandelmarch::bench {

namespace rules {

// Times of 0 or less are read without an error. If a configuration has one, `bench compare` reports that it cannot be
// compared.
inline constexpr Rule seconds{.min = -1e9, .max = 1e9, .timed = true};
inline constexpr Rule required_seconds{.min = -1e9, .max = 1e9, .timed = true, .required = true};
inline constexpr Rule energy{.max = 1e9};
inline constexpr Rule real{.min = -1e6, .max = 1e6};
inline constexpr Rule rate{.max = 1e30, .timed = true};
inline constexpr Rule fraction{.max = 1};
inline constexpr Rule count{.timed = true};
inline constexpr Rule text_or_null{.null = Null::empty};
inline constexpr Rule required{.required = true};
inline constexpr Rule infinite{.min = -std::numeric_limits<double>::infinity(),
                               .max = std::numeric_limits<double>::infinity(),
                               .null = Null::infinite,
                               .about = "null: infinite"};
constexpr Rule about(Rule rule, const char* text)
{
    rule.about = text;
    return rule;
}

}  // namespace rules

template <>
inline constexpr auto values_of<Precision> = std::array{Precision::f32, Precision::f64};
template <>
inline constexpr auto values_of<Mode> = std::array{Mode::exact, Mode::fast};

template <>
inline constexpr auto values_of<Verdict> =
    std::array{Verdict::faster,  Verdict::slower,   Verdict::same,         Verdict::undecided, Verdict::wrong,
               Verdict::missing, Verdict::only_new, Verdict::not_compared, Verdict::no_speed};

}  // namespace mandelmarch::bench
