// SPDX-License-Identifier: Apache-2.0
// Formats in which a result is printed.
#pragma once

#include <string>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Returns the table of configurations, tables of ratios (speed-ups, Mandelbox / Mandelbulb, double / float), the
// study's own tables, warnings and the winners, in lines of at most 120 characters. `all_columns`: true for a table of
// configurations with all columns, in lines of any length.
std::string to_console(const Result& result, bool all_columns);

// Returns the table of configurations. In a sweep it has the sweep value instead of the share of peak and the speed-up.
std::string main_table(const Result& result);

// Returns the tables of the studies box-vs-bulb and ladder; empty for other studies.
std::string study_tables(const Result& result);

// Returns CSV with one line per configuration. The first columns are problem, application, platform and fom (pixels per
// second of kernel time, higher is better; empty without a speed). The columns application and backend both hold
// Row::application, so that a pivot table by either column compares the same programs. p3-analysis-library needs
// another CSV, to_csv() of bench/result/portability.h.
std::string to_csv(const Result& result);

// Returns the name of a problem, which all comparable configurations share: "mandelbulb double exact 540x540".
std::string problem_name(const std::string& fractal, Precision precision, Mode mode, int width, int height);

// Returns a text as one CSV cell, quoted if necessary.
std::string csv_cell(const std::string& text);

}  // namespace mandelmarch::bench
