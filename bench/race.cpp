// SPDX-License-Identifier: Apache-2.0
#include "bench/race.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/console_studies.h"
#include "bench/statistics.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t name_columns = 28;

std::vector<double> seconds_of(const RacedProgram& racer)
{
    std::vector<double> seconds;
    for (const RaceSample& sample : racer.samples) seconds.push_back(sample.seconds);
    return seconds;
}

bool timed(const RacedProgram& racer) { return is_right(racer.verdict) && !racer.samples.empty(); }

// Returns our program, the baseline of the times; nullptr if it was not timed.
const RacedProgram* pace_of(const Race& race)
{
    const auto found = std::ranges::find_if(race.racers, [](const RacedProgram& r) { return r.ours && timed(r); });
    return found == race.racers.end() ? nullptr : &*found;
}

std::optional<Quotient> times_ours(const Race& race, const RacedProgram& racer)
{
    const RacedProgram* pace = pace_of(race);
    if (pace == nullptr || !timed(racer)) return std::nullopt;
    return quotient({{0, seconds_of(racer)}}, {{0, seconds_of(*pace)}});
}

// Truncates a long name at its start, as the end of a path is the specific part.
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

bool Race::held() const
{
    return std::ranges::all_of(racers, [](const RacedProgram& racer) { return is_right(racer.verdict); });
}

std::string to_console(const Race& race)
{
    const double pixels = static_cast<double>(race.width) * race.height;
    std::string text = fmt::format("{:<28} {:<13} {:>9} {:<20} {:>8} {:<16} {:>7} {:>5}\n", "program", "picture",
                                   "wall ms", "95 % interval", "x ours", "95 % interval", "MB", "exit");
    const auto line = [&](const std::string& whole) { text += clipped(whole, console_columns) + "\n"; };
    for (const RacedProgram& racer : race.racers) {
        const std::string verdict = verdict_in_table(racer, pixels);
        if (!timed(racer)) {
            line(fmt::format("{:<28} {:<13} {}", name_in_table(racer), verdict, printable(racer.why)));
            continue;
        }
        const Summary s = summary(seconds_of(racer));
        const auto ratio = times_ours(race, racer);
        const auto interval = [](const std::optional<Interval>& i, double unit, int count) {
            return i ? fmt::format("[{}, {}]", digits(unit * i->low), digits(unit * i->high))
                     : fmt::format("n = {}", count);
        };
        line(fmt::format("{:<28} {:<13} {:>9} {:<20} {:>8} {:<16} {:>7.0f} {:>5}", name_in_table(racer), verdict,
                         digits(1e3 * s.median), interval(s.interval, 1e3, s.count), ratio ? digits(ratio->ratio) : "",
                         ratio ? interval(ratio->interval, 1, s.count) : "", 1e-6 * static_cast<double>(racer.memory),
                         racer.exit_code.value_or(0)));
    }
    text += fmt::format("{}, {} x {} pixels, {} runs of each whole process in alternation, {:g} s at most\n",
                        race.fractal, race.width, race.height, race.rounds, race.limit);
    for (const std::string& warning : race.warnings) text += printable("warning: " + warning, longest_note) + "\n";
    return text;
}

nlohmann::ordered_json json_of(const Race& race)
{
    const auto interval = [](const std::optional<Interval>& i) { return i ? Json{i->low, i->high} : Json(); };
    const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(); };
    Json racers = Json::array();
    for (const RacedProgram& racer : race.racers) {
        Json picture;
        if (racer.picture) {
            const RacePicture& p = *racer.picture;
            picture = {{"width", p.width},
                       {"height", p.height},
                       {"differing", p.differing},
                       {"visibly_differing", p.visibly_differing},
                       {"first", p.first_x < 0 ? Json() : Json{p.first_x, p.first_y}},
                       {"psnr", std::isfinite(p.psnr) ? Json(p.psnr) : Json()}};
        }
        Json samples = Json::array();
        Json wall;
        Json ratio;
        if (timed(racer)) {
            for (const RaceSample& s : racer.samples) {
                samples.push_back({{"round", s.round}, {"wall", s.seconds}, {"processor", s.processor}});
            }
            const Summary s = summary(seconds_of(racer));
            wall = {{"median", s.median}, {"interval", interval(s.interval)}};
            if (const auto q = times_ours(race, racer)) {
                ratio = {{"ratio", q->ratio}, {"interval", interval(q->interval)}};
            }
        }
        racers.push_back({{"name", printable(racer.name)},
                          {"ours", racer.ours},
                          {"verdict", name_of(racer.verdict)},
                          {"why", racer.why.empty() ? Json() : Json(printable(racer.why))},
                          {"exit_code", or_null(racer.exit_code)},
                          {"signal", or_null(racer.signal)},
                          {"picture", picture},
                          {"memory", racer.memory},
                          {"wall", wall},
                          {"times_ours", ratio},
                          {"samples", samples}});
    }
    return {{"schema", "mandelmarch-race"},  {"version", 1},        {"environment", race.environment},
            {"fractal", race.fractal},       {"width", race.width}, {"height", race.height},
            {"parameters", race.parameters}, {"limit", race.limit}, {"rounds", race.rounds},
            {"warnings", race.warnings},     {"programs", racers}};
}

}  // namespace mandelmarch::bench
