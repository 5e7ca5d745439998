// SPDX-License-Identifier: Apache-2.0
// bench duel: two programs measured in alternation, picture by picture, and what that says.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/statistics.h"
#include "bench/verdict.h"

namespace mandelmarch::bench {

// Which seconds a duel compares.
enum class DuelClock {
    wall,      // of the kernel, as bench's own figures
    processor  // of all threads: what other programs take from the machine costs none
};
std::string_view name_of(DuelClock clock);

// What was measured. A pair is one picture of each program, one right after the other; which is first is drawn by lot.
struct DuelPair {
    int launch = 0, round = 0;
    double old_seconds = 0, new_seconds = 0;
};

struct DuelRow {
    std::string name;
    std::vector<DuelPair> pairs{};
    std::string old_failure{}, new_failure{};  // why a program has no speed here; empty if it has one
    bool same_picture = true;                  // byte for byte
};

struct DuelSide {
    std::string program;
    nlohmann::ordered_json environment = nlohmann::ordered_json::object();
};

struct Duel {
    DuelSide old_side{}, new_side{};
    DuelClock clock = DuelClock::wall;
    double margin = 0.01;  // a ratio within this of 1 is the same
    int launches = 0;      // of each program, that were measured to their end
    int rounds = 0;        // in each
    std::vector<std::string> warnings{};
    std::vector<DuelRow> rows{};
};

struct Judged {
    std::string name;  // of the row; all_rows for the mean of all
    Verdict verdict = Verdict::no_speed;
    std::string why{};        // where nothing was tested
    Difference difference{};  // of times, new / old
    double p = 1;             // after Holm's correction
    int launches = 0, pairs = 0;
    bool same_picture = true;
};

inline constexpr std::string_view all_rows = "all rows";

// Judges each row and, if several were tested, also their geometric mean, which comes last (judge_all()). For each
// launch, take the median of the pairs' ratios; Student's t of the logarithms of these medians tests whether the ratio
// lies beyond the margin.
std::vector<Judged> judge(const Duel& duel);

// A row is slower or broken.
bool regression(const std::vector<Judged>& judged);

std::string to_console(const Duel& duel, const std::vector<Judged>& judged);

// As bench/schemas/duel.schema.json says.
nlohmann::ordered_json json_of(const Duel& duel, const std::vector<Judged>& judged);

}  // namespace mandelmarch::bench
