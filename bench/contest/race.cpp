// SPDX-License-Identifier: Apache-2.0
#include "bench/contest/race.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/base/table.h"
#include "bench/base/statistics.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

constexpr std::size_t name_columns = 28;

std::vector<double> seconds_of(const RacedProgram& racer)
{
    std::vector<double> seconds;
    for (const RaceSample& sample : racer.samples) seconds.push_back(sample.seconds);
    return seconds;
}

// Truncates a long name at its start, because the end of a path identifies the program.
std::string name_in_table(const RacedProgram& racer)
{
    std::string name = printable(racer.name);
    if (name.size() > name_columns) name = "..." + name.substr(name.size() - name_columns + 3);
    return name;
}

std::string verdict_in_table(const RacedProgram& racer, double pixels)
{
    if (racer.verdict != RaceVerdict::close) return std::string(name_of(racer.verdict));
    return fmt::format("{:.3f} % off", 100 * static_cast<double>(racer.picture->visibly_differing) / pixels);
}

}  // namespace

std::string_view name_of(RaceVerdict verdict)
{
    switch (verdict) {
        case RaceVerdict::same: return "same bytes";
        case RaceVerdict::close: return "close";
        case RaceVerdict::wrong: return "WRONG";
        case RaceVerdict::wrong_size: return "WRONG SIZE";
        case RaceVerdict::no_picture: return "NO PICTURE";
        case RaceVerdict::no_image: return "NO IMAGE FILE";
        case RaceVerdict::unsteady: return "UNSTEADY";
        case RaceVerdict::failed: return "FAILED";
        case RaceVerdict::crashed: return "CRASHED";
        case RaceVerdict::hung: return "HUNG";
        default: return "NO START";
    }
}

bool Race::passed() const
{
    return std::ranges::all_of(racers, [](const RacedProgram& racer) { return is_right(racer.verdict); });
}

Race timed(Race race)
{
    std::vector<double> ours;
    for (RacedProgram& racer : race.racers) {
        if (!is_right(racer.verdict)) racer.samples.clear();
        if (racer.samples.empty()) continue;
        racer.wall = summary(seconds_of(racer));
        if (racer.ours && ours.empty()) ours = seconds_of(racer);
    }
    for (RacedProgram& racer : race.racers) {
        if (racer.wall && !ours.empty()) racer.times_ours = quotient({{0, seconds_of(racer)}}, {{0, ours}});
    }
    return race;
}

std::string to_console(const Race& race)
{
    const double pixels = static_cast<double>(race.width) * race.height;
    std::string text = fmt::format("{:<28} {:<13} {:>9} {:<20} {:>8} {:<16} {:>7} {:>5}\n", "program", "picture",
                                   "wall ms", "95 % interval", "x ours", "95 % interval", "MB", "exit");
    const auto line = [&](const std::string& whole) { text += clipped(whole, console_columns) + "\n"; };
    for (const RacedProgram& racer : race.racers) {
        const std::string verdict = verdict_in_table(racer, pixels);
        if (!racer.wall) {
            line(fmt::format("{:<28} {:<13} {}", name_in_table(racer), verdict, printable(racer.why)));
            continue;
        }
        const Summary& s = *racer.wall;
        const auto& ratio = racer.times_ours;
        line(fmt::format("{:<28} {:<13} {:>9} {:<20} {:>8} {:<16} {:>7.0f} {:>5}", name_in_table(racer), verdict,
                         digits(1e3 * s.median), interval_text(s.interval, s.count, 1e3),
                         ratio ? digits(ratio->ratio) : "", ratio ? interval_text(ratio->interval, s.count) : "",
                         1e-6 * static_cast<double>(racer.memory), racer.exit_code.value_or(0)));
    }
    text += fmt::format("{}, {} x {} pixels, {} runs of each whole process in alternation, {:g} s at most\n",
                        race.fractal, race.width, race.height, race.rounds, race.limit);
    return text + notes("warning: ", race.warnings);
}

}  // namespace mandelmarch::bench
