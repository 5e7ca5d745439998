// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bench/print/printers.h"
#include "bench/result/figures.h"
#include "bench/result/winners.h"
#include "bench/statistics/table.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

std::string short_name(const std::string& fractal)
{
    return fractal == "all" ? fractal : std::string(fractal_named(fractal).short_name);
}

std::string percent(const std::optional<double>& share)
{
    return share ? fmt::format("{:.1f}%", 100 * *share) : std::string("-");
}

std::optional<double> ratio_of(const std::optional<Quotient>& quotient)
{
    return quotient ? std::optional(quotient->ratio) : std::nullopt;
}

std::string of(const std::optional<double>& value, double unit) { return value ? digits(unit * *value) : "-"; }

// Returns the row's application, short enough for a column. An application such as program:./mine is called by the
// place of its row among those of its kind: program[1]; devices() has the whole name.
std::string short_application(const Result& result, const Row& row)
{
    const auto colon = row.application.find(':');
    if (colon == std::string::npos) return row.application;
    std::set<std::string> before;
    std::size_t place = 0;
    for (const Row& other : result.rows) {
        if (!other.application.starts_with(row.application.substr(0, colon + 1))) continue;
        if (before.insert(other.application).second && other.application == row.application) place = before.size();
    }
    return fmt::format("{}[{}]", row.application.substr(0, colon), place);
}

// Returns a table whose first columns name a row, as cells_of() does.
Table row_table(std::initializer_list<const char*> more)
{
    std::vector<std::string> heads{"<scene", "<precision", "<mode", "<backend", ">dev"};
    heads.insert(heads.end(), more.begin(), more.end());
    return Table(std::move(heads));
}

// Returns the cells that name a row, and more cells.
template <class... More>
std::vector<std::string> cells_of(const Result& result, const Row& row, const More&... more)
{
    if (row.device_name.empty()) return {"all", "all", "all", row.backend, "-", more...};
    return {short_name(row.fractal),        std::string(name_of(row.precision)), std::string(name_of(row.mode)),
            short_application(result, row), fmt::format("{}", row.device),       more...};
}

std::string why_not_timed(const Row& row)
{
    if (!row.unavailable.empty()) return "unavailable: " + row.unavailable;
    return "FAILED: " + (row.failure.empty() ? "no sample" : row.failure);
}

// The tables of configurations, as bits: of a sweep, of another study, and with --wide.
enum In : unsigned { sweep = 1, standard = 2, narrow = sweep | standard, wide = 4, all = narrow | wide };

struct Column {
    const char* head;  // as in Table
    unsigned in;       // the tables that have the column
    std::string (*cell)(const Row& row, const Figures& figures);
};

constexpr Column columns[] = {
    {"<verification", all, [](const Row& row, const Figures&) { return row.verification.text; }},
    {">samples", wide, [](const Row& row, const Figures&) { return std::to_string(row.samples.size()); }},
    {">kernel", all, [](const Row&, const Figures& f) { return digits(1e3 * f.kernel.median); }},
    {"<95 % interval", all,
     [](const Row&, const Figures& f) { return interval_text(f.kernel.interval, f.kernel.count, 1e3); }},
    {">MAD ms", wide, [](const Row&, const Figures& f) { return digits(1e3 * f.kernel.mad); }},
    {">wall ms", all, [](const Row&, const Figures& f) { return digits(1e3 * f.wall.median); }},
    {">context", wide, [](const Row& row, const Figures&) { return digits(1e3 * row.context); }},
    {">build", wide, [](const Row& row, const Figures&) { return digits(1e3 * row.build); }},
    {">upload", wide, [](const Row&, const Figures& f) { return digits(1e3 * f.upload); }},
    {">trial", wide, [](const Row&, const Figures& f) { return digits(1e3 * f.trial); }},
    {">host", wide, [](const Row&, const Figures& f) { return digits(1e3 * f.host); }},
    {">readback", wide, [](const Row&, const Figures& f) { return digits(1e3 * f.readback); }},
    {">Mpixel/s", all, [](const Row&, const Figures& f) { return digits(1e-6 * f.pixel_rate); }},
    {">Mcall/s", wide, [](const Row&, const Figures& f) { return digits(1e-6 * f.estimate_rate); }},
    {">Miter/s", wide, [](const Row&, const Figures& f) { return digits(1e-6 * f.iteration_rate); }},
    {">GFLOP", wide,
     [](const Row& row, const Figures&) { return row.operations > 0 ? digits(1e-9 * row.operations) : "-"; }},
    {">GFLOP/s", all, [](const Row&, const Figures& f) { return of(f.operation_rate, 1e-9); }},
    {">peak GFLOP/s", wide, [](const Row&, const Figures& f) { return of(f.peak, 1e-9); }},
    {">peak", standard | wide, [](const Row&, const Figures& f) { return percent(f.share); }},
    {">bound ms", wide, [](const Row&, const Figures& f) { return of(f.bound, 1e3); }},
    {">speed-up", standard | wide, [](const Row&, const Figures& f) { return of(ratio_of(f.speed_up), 1); }},
    {">joules", wide, [](const Row&, const Figures& f) { return f.joules ? digits(*f.joules) : ""; }},
    {">thr", wide, [](const Row& row, const Figures&) { return std::to_string(row.threads); }},
    {">SIMD", wide, [](const Row& row, const Figures&) { return std::to_string(row.simd_width); }},
    {"<set", wide, [](const Row& row, const Figures&) { return row.instruction_set; }}};

std::string table_in(const Result& result, In table)
{
    std::vector<std::string> heads{"<scene", "<precision", "<mode", "<backend", ">dev", "<point"};
    if (table == wide) heads = {"<row"};
    for (const Column& column : columns) {
        if ((column.in & table) != 0) heads.emplace_back(column.head);
    }
    Table made(std::move(heads));
    for (const Row& row : result.rows) {
        std::vector<std::string> cells =
            table == wide ? std::vector{row.name()} : cells_of(result, row, table == sweep ? row.sweep_value : "");
        if (!row.timed()) cells.push_back(why_not_timed(row));
        for (const Column& column : columns) {
            if (row.timed() && (column.in & table) != 0) cells.push_back(column.cell(row, *row.figures));
        }
        made.add_cells(std::move(cells));
    }
    return made.text(table == wide ? std::string::npos : console_columns);
}

std::string devices(const Result& result)
{
    std::set<std::string> told;
    std::string text;
    for (const Row& row : result.rows) {
        if (row.device_name.empty() || !told.insert(fmt::format("{} {}", row.backend, row.device)).second) continue;
        const bool is_short = row.backend.find(':') == std::string::npos;
        text += clipped(fmt::format("{} {}: {}{} ({})", is_short ? row.backend : short_application(result, row),
                                    row.device, is_short ? "" : row.backend + ", ", row.device_name, row.driver),
                        console_columns) +
                "\n";
    }
    for (const Peak& peak : result.peaks) {
        const Peak* best = peak_of(result, peak.platform, peak.precision);
        text +=
            clipped(fmt::format("peak, {}, {} {}: {} GFLOP/s of multiply-adds{}", name_of(peak.precision), peak.backend,
                                peak.device, digits(1e-9 * peak.rate), &peak == best ? ", the device's peak" : ""),
                    console_columns) +
            "\n";
    }
    return text;
}

// Returns a table of the configurations whose upload, host and readback leave more than 5 % of the wall time
// unaccounted for.
std::string incomplete_parts(const Result& result)
{
    constexpr double little = 0.05;
    Table table = row_table({"<point", ">share"});
    for (const Row& row : result.rows) {
        if (!row.timed() || row.figures->unaccounted.value_or(0) <= little) continue;
        table.add_cells(cells_of(result, row, row.sweep_value, percent(row.figures->unaccounted)));
    }
    const std::string text = table.text(console_columns);
    if (text.empty()) return {};
    return fmt::format("\nOf these rows' wall time, upload, host and readback leave more than {}\n{}", percent(little),
                       text);
}

// Returns the sweep value for the end of a line; empty outside sweeps.
std::string point_of(const Result& result, const Row& row)
{
    return result.study == standard_study ? "" : row.sweep_value;
}

std::string interval_of(const std::optional<Quotient>& quotient)
{
    if (!quotient) return "";
    if (quotient->interval) return interval_text(*quotient->interval);
    return quotient->ratio == 1.0 ? "its own baseline" : "too few samples";
}

// Returns the table of speed-ups over both baselines.
std::string speed_ups(const Result& result)
{
    Table table = row_table({">serial", "<95 % interval", ">scalar", "<95 % interval", "<point"});
    for (const Row& row : result.rows) {
        if (!row.timed() || (!row.figures->speed_up && !row.figures->over_scalar)) continue;
        const Figures& f = *row.figures;
        table.add_cells(cells_of(result, row, of(ratio_of(f.speed_up), 1), interval_of(f.speed_up),
                                 of(ratio_of(f.over_scalar), 1), interval_of(f.over_scalar), point_of(result, row)));
    }
    const std::string text = table.text(console_columns);
    if (text.empty()) return {};
    return "\nSpeed-up of wall time: over reference (serial, double, exact), and over the kernel as scalar C++ on the "
           "host's\nthreads, in the row's precision and mode; intervals not corrected for their number\n" +
           text;
}

std::string ratio_table(const Result& result, const std::vector<Ratio>& ratios, const std::string& title, bool fractal)
{
    if (ratios.empty()) return {};
    Table table = row_table({">ratio", "<95 % interval", ">pairs", "<point"});
    for (const Ratio& ratio : ratios) {
        const Row& row = result.row(ratio.denominator);
        std::vector<std::string> cells = cells_of(result, row, ratio.ratio.count > 0 ? digits(ratio.ratio.median) : "-",
                                                  interval_text(ratio.ratio.interval, ratio.ratio.count),
                                                  fmt::format("{}", ratio.ratio.count), point_of(result, row));
        cells.at(fractal ? 1 : 0).clear();
        table.add_cells(std::move(cells));
    }
    return fmt::format("\n{}; intervals not corrected for their number\n{}", title, table.text(console_columns));
}

}  // namespace

std::string main_table(const Result& result)
{
    const bool swept = result.study != standard_study && result.study != demo_study &&
                       std::ranges::any_of(result.rows, [](const Row& row) { return !row.sweep_value.empty(); });
    return table_in(result, swept ? sweep : standard);
}

std::string to_console(const Result& result, bool all_columns)
{
    const Row* any = nullptr;
    for (const Row& row : result.rows) {
        if (any == nullptr && row.timed()) any = &row;
    }
    std::string text = all_columns ? table_in(result, wide) : main_table(result);
    text += fmt::format("\n{}", devices(result));
    if (any != nullptr && result.study == standard_study) {
        text += fmt::format(
            "{} x {} pixels; kernel and wall: medians in ms; speed-up: over reference; {}-scalar: the kernel "
            "as scalar C++\n",
            any->setting.width, any->setting.height, result.host());
    }
    text += incomplete_parts(result);
    text += speed_ups(result);
    text += ratio_table(result, result.questions.box_to_bulb,
                        "Mandelbox against Mandelbulb: ratio of their kernel times", false);
    text += ratio_table(result, result.questions.double_to_float, "Double against float: ratio of their kernel times",
                        true);
    text += study_tables(result);
    for (const std::string& warning : result.warnings)
        text += fmt::format("\n{}", clipped(fmt::format("warning: {}", warning), console_columns));
    if (!result.warnings.empty()) text += "\n";
    return text + winners(result);
}

}  // namespace mandelmarch::bench
