// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "bench/print/printers.h"
#include "bench/result/figures.h"
#include "bench/statistics/table.h"

namespace mandelmarch::bench {
namespace {

double ratio(std::uint64_t a, std::uint64_t b) { return b == 0 ? 0 : static_cast<double>(a) / static_cast<double>(b); }

// Returns a table of the counted work, which explains why one fractal is slower than another.
std::string counts_table(const Result& result)
{
    Table table({"<fractal", "<precision", "<mode", "<scene", ">calls/pixel", ">iter/call", ">ops/iter",
                 ">quotients/iter", ">ops/pixel", ">active steps", ">active iters"});
    for (const Counted& c : result.counts) {
        const Count& n = c;
        const Operations all = n.all();
        const auto pixels = static_cast<double>(n.pixels);
        const ActiveLanes& together = n.lane_use.front().together;
        table.add(c.fractal, name_of(c.precision), name_of(c.mode), c.setting.view,
                  fmt::format("{:.2f}", static_cast<double>(n.work.de_calls) / pixels),
                  fmt::format("{:.2f}", ratio(n.march_iterations, n.march_estimates)),
                  fmt::format("{:.1f}", n.per_iteration()),
                  fmt::format("{:.2f}", ratio(all.divisions + all.square_roots, n.work.iterations)),
                  fmt::format("{:.0f}", n.per_iteration() * static_cast<double>(n.work.iterations) / pixels),
                  fmt::format("{:.0f}%", 100 * together.in_steps),
                  fmt::format("{:.0f}%", 100 * together.in_iterations));
    }
    return fmt::format(
        "\nWork of the kernel, counted\n{}calls: of the distance estimator; ops: + - * quotient root, of all stages; "
        "quotients include\nroots; active: lanes that do something, in packs of {} pixels\n",
        table.text(console_columns), result.counts.empty() ? 0 : result.counts.front().lane_use.front().lanes);
}

// Returns a table of lane utilisation without and with refill, and of the gain. With refill, a lane takes the next
// pixel as soon as the lane's ray has ended.
std::string lanes_table(const Result& result)
{
    Table table({"<fractal", "<precision", "<mode", "<scene", ">lanes", ">together: steps", ">iters",
                 ">refilled: steps", ">iters", ">gain"});
    for (const Counted& c : result.counts) {
        for (const LaneUse& use : c.lane_use) {
            if (!use.refilled) continue;
            const auto share = [](double active) { return fmt::format("{:.0f}%", 100 * active); };
            table.add(c.fractal, name_of(c.precision), name_of(c.mode), c.setting.view, use.lanes,
                      share(use.together.in_steps), share(use.together.in_iterations), share(use.refilled->in_steps),
                      share(use.refilled->in_iterations),
                      fmt::format("{:.2f}", use.refilled->in_iterations / use.together.in_iterations));
        }
    }
    return "\nLanes that do something while rays march: of the steps, of the estimator's iterations\n" +
           table.text(console_columns) +
           "together: neighbouring pixels go on until the last is done; refilled: a lane whose ray has ended takes the "
           "next\npixel of a block of 256; gain: iterations a cycle, refilled over together, without what refilling "
           "costs\n";
}

// Returns a table of each fractal's ladder, with the gain of each rung over the rung before it, and of the last rung
// over the first.
std::string ladder_table(const Result& result)
{
    const auto gain = [](const Ratio& ratio) {  // ratio of kernel times, earlier rung / later rung
        return digits(1 / ratio.ratio.median);
    };
    const auto interval = [](const Ratio& ratio) {
        const auto& of = ratio.ratio.interval;
        return of ? interval_text({1 / of->high, 1 / of->low}) : fmt::format("n = {}", ratio.ratio.count);
    };
    Table table({"<fractal", "<rung", ">ms", ">gain", "<95 % interval"});
    for (const Row& row : result.rows) {
        if (!row.timed()) continue;
        const auto is_of_row = [&](const Ratio& ratio) {
            return ratio.numerator == row.name() && ratio.ratio.count > 0;
        };
        const auto step = std::ranges::find_if(result.questions.to_previous_value, is_of_row);
        const bool compared = step != result.questions.to_previous_value.end();
        table.add(row.fractal, row.sweep_value, digits(1e3 * row.figures->kernel.median), compared ? gain(*step) : "",
                  compared ? interval(*step) : "");
        const auto whole = std::ranges::find_if(result.questions.to_first_value, is_of_row);
        const bool last = &row == &result.rows.back() || (&row + 1)->fractal != row.fractal;
        if (!last || whole == result.questions.to_first_value.end()) continue;
        table.add(row.fractal, "all together", "", gain(*whole), interval(*whole));
    }
    return "\nThe ladder: each rung changes one thing, and gains a factor of kernel time\n" +
           table.text(console_columns);
}

}  // namespace

std::string study_tables(const Result& result)
{
    std::string text;
    if (result.study == "box-vs-bulb") text += counts_table(result) + lanes_table(result);
    if (result.study == ladder_study) text += ladder_table(result);
    return text;
}

}  // namespace mandelmarch::bench
