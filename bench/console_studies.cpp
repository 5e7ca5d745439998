// SPDX-License-Identifier: Apache-2.0
#include "bench/console_studies.h"

#include <fmt/format.h>

#include "bench/figures.h"
#include "bench/profile.h"

namespace mandelmarch::bench {
namespace {

double ratio(std::uint64_t a, std::uint64_t b) { return b == 0 ? 0 : static_cast<double>(a) / static_cast<double>(b); }

// Why one fractal is slower than the other.
std::string counts_table(const Result& result)
{
    std::string text = fmt::format(
        "\nWork of the text, counted\n{:<11} {:<6} {:<5} {:<9} {:>8} {:>9} {:>8} {:>9} {:>9} {:>7} {:>7}\n", "fractal",
        "number", "mode", "scene", "calls", "iter per", "ops per", "quotients", "ops per", "active", "active");
    text += fmt::format("{:<11} {:<6} {:<5} {:<9} {:>8} {:>9} {:>8} {:>9} {:>9} {:>7} {:>7}\n", "", "", "", "",
                        "per pix", "call", "iter", "per iter", "pixel", "steps", "iters");
    for (const Counted& c : result.counts) {
        const Count& n = c.count;
        const Operations all = n.all();
        text +=
            fmt::format("{:<11} {:<6} {:<5} {:<9} {:>8.2f} {:>9.2f} {:>8.1f} {:>9.2f} {:>9.0f} {:>6.0f}% {:>6.0f}%\n",
                        c.fractal, name_of(c.precision), name_of(c.mode), c.setting.view,
                        ratio(n.work.estimates, n.pixels), ratio(n.march_iterations, n.march_estimates),
                        n.per_iteration(), ratio(all.quotients + all.roots, n.work.iterations),
                        ratio(all.total(), n.pixels), 100 * n.active_in_steps, 100 * n.active_in_iterations);
    }
    return text + fmt::format(
                      "calls: of the distance estimator; ops: + - * quotient root, of all stages; quotients with "
                      "roots; active: lanes\nthat do something, in packs of {} pixels\n",
                      result.counts.empty() ? 0 : result.counts.front().count.lanes);
}

std::string stages_table(const Result& result)
{
    std::string text = fmt::format(
        "\nWhere a picture's time goes, in packs on one core; operations as counted\n{:<11} {:<6} {:<5} {:<7} "
        "{:>9} {:>7} {:>11}\n",
        "fractal", "number", "mode", "stage", "ms", "time", "operations");
    for (const StageTime& s : result.stages) {
        double all = 0;
        for (const StageTime& other : result.stages) {
            const bool same = other.fractal == s.fractal && other.precision == s.precision && other.mode == s.mode;
            if (same && other.stage != in_one_go) all += median(other.seconds);
        }
        std::string operations = "-";
        for (const Counted& c : result.counts) {
            if (c.fractal != s.fractal || c.precision != s.precision || c.mode != s.mode) continue;
            for (int i = 0; i < stage_count; ++i) {
                if (name_of(static_cast<Stage>(i)) != s.stage) continue;
                operations = fmt::format("{:.1f}%", 100 * ratio(c.count.stages.at(static_cast<std::size_t>(i)).total(),
                                                                c.count.all().total()));
            }
        }
        text += fmt::format("{:<11} {:<6} {:<5} {:<7} {:>9} {:>6.1f}% {:>11}\n", s.fractal, name_of(s.precision),
                            name_of(s.mode), s.stage, digits(1e3 * median(s.seconds)),
                            all > 0 ? 100 * median(s.seconds) / all : 0, operations);
    }
    return text;
}

}  // namespace

std::string study_tables(const Result& result)
{
    std::string text;
    if (result.study == "box-vs-bulb") text += counts_table(result);
    if (!result.stages.empty()) text += stages_table(result);
    return text;
}

}  // namespace mandelmarch::bench
