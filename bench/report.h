// The reporters: one file for each form that a result takes.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/result.h"
#include "bench/runner.h"

namespace mandelmarch::bench {

// Lines of at most 120 characters: the table of rows, the two questions, what a study has to say, warnings.
// `wide`: everything that was measured, in lines as long as that takes.
std::string to_console(const Result& result, bool wide);

// As bench/result.schema.json says; raw samples and derived figures both.
nlohmann::ordered_json to_json(const Result& result);

// Reads what to_json wrote; derived figures are left out, as they follow from the samples. `name` is what messages call
// the file. Throws InputError where it is no result, or one of another version.
Result from_json(const nlohmann::ordered_json& json, const std::string& name);
Result read_result(const std::string& path);

// One line a row; the first columns are problem, application, platform and fom (pixels per second of kernel time,
// higher is better; empty where there is none), as p3-analysis-library reads them.
std::string to_csv(const Result& result);

// As Google Benchmark's own reporter prints the runs: "console", "json" or "csv". Throws InputError for another format.
std::string to_google_benchmark(const Result& result, const Runs& runs, const std::string& format);

// Writes text into a file, whole or not at all, or to standard output where the path is "-".
void write_text(const std::string& path, const std::string& text);

}  // namespace mandelmarch::bench
