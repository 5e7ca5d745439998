// SPDX-License-Identifier: Apache-2.0
// Result files of bench.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Returns what a file holds: facts alone.
nlohmann::ordered_json facts_of(const Result& result);
// Returns the facts with all figures that follow from them, as `bench json` prints them.
nlohmann::ordered_json json_of(const Result& result);

// Read a result in either form, and compute its figures. `name`: the file's name in messages. Throw InputError if the
// JSON is not a result, has another version, or has impossible values.
Result result_from_json(const nlohmann::ordered_json& json, const std::string& name);
Result parse_result(const std::string& text, const std::string& name);
Result read_result(const std::string& path);
// Reads a result. Returns nullopt if the file is of another kind, whether it is JSON or not. Throws InputError if the
// file cannot be read or is a damaged result.
std::optional<Result> read_if_result(const std::string& path);
// Returns the contents of a file of any kind. Throws InputError if it cannot be read or is not JSON.
nlohmann::ordered_json json_in(const std::string& path);
// Returns `paths` with each folder replaced by the paths of all files in it and its subfolders whose names end in
// .json, sorted.
std::vector<std::string> result_files(const std::vector<std::string>& paths);

// Formats JSON for a file; all samples of a row take one line. Invalid UTF-8, for example in a driver's name, is
// replaced.
std::string text_of(const nlohmann::ordered_json& json);

}  // namespace mandelmarch::bench
