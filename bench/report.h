// SPDX-License-Identifier: Apache-2.0
// The reporters: one file for each form that a result takes.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/result.h"

namespace mandelmarch::bench {

// Lines of at most 120 characters: the table of rows, the two questions, what a study has to say, warnings.
// `wide`: everything that was measured, in lines as long as that takes.
std::string to_console(const Result& result, bool wide);

// As bench/result.schema.json says; raw samples and derived figures both.
nlohmann::ordered_json json_of(const Result& result);

// Reads what json_of wrote; derived figures are left out, as they follow from the samples. `name` is what messages call
// the file. Throws InputError where it is no result, one of another version, or holds values that no study has.
Result result_from_json(const nlohmann::ordered_json& json, const std::string& name);
Result parse_result(const std::string& text, const std::string& name);
Result read_result(const std::string& path);
// nullopt for a file of another kind, JSON or not. Throws InputError where it cannot be read or is a damaged result.
std::optional<Result> read_if_result(const std::string& path);
// The given files, and for a folder all files in it and below that end in .json, sorted.
std::vector<std::string> result_files(const std::vector<std::string>& paths);

// A JSON file's text. Bytes that are no UTF-8, in a driver's name say, are replaced.
std::string text_of(const nlohmann::ordered_json& json);

// One line a row; the first columns are problem, application, platform and fom (pixels per second of kernel time,
// higher is better; empty where there is none). The columns application and backend both hold application_of(), so that
// a pivot by either one compares what was timed. p3-analysis-library needs the CSV of bench/portability.h instead.
std::string to_csv(const Result& result);

// What is solved, so that rows of one problem can be compared: "mandelbulb double exact 540x540".
std::string problem_name(const std::string& fractal, Precision precision, Mode mode, int width, int height);

// A text as one cell of CSV, quoted where it must be.
std::string csv_cell(const std::string& text);

// As Google Benchmark's own reporter prints repetitions: the samples of all launches, a row's median behind them.
// `format`: "console", "json" or "csv"; throws InputError for another.
std::string to_google_benchmark(const Result& result, const std::string& format);

}  // namespace mandelmarch::bench
