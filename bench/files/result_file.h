// SPDX-License-Identifier: Apache-2.0
// Result files of bench.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/result/result.h"

namespace mandelmarch::bench {

// Returns JSON that follows bench/schemas/result.schema.json, with raw samples and derived figures.
nlohmann::ordered_json json_of(const Result& result);

// Parse a result written by json_of(). Derived quantities are not read; they are computed again from the samples.
// `name`: the file's name in messages. Throw InputError if the JSON is not a result, has an unknown version, or has
// impossible values.
Result result_from_json(const nlohmann::ordered_json& json, const std::string& name);
Result parse_result(const std::string& text, const std::string& name);
Result read_result(const std::string& path);
// Reads a result. Returns nullopt if the file is not a result, whether it is JSON or not. Throws InputError if the file
// cannot be read or is a damaged result.
std::optional<Result> read_if_result(const std::string& path);
// Reads a file of bench and returns its contents in the current format. In a result, all figures are computed again
// from the samples. Throws InputError if the file cannot be read or is not a file of bench.
nlohmann::ordered_json upgraded_json(const std::string& path);
// Returns `paths` with each folder replaced by the paths of all files in it and its subfolders whose names end in
// .json, sorted.
std::vector<std::string> result_files(const std::vector<std::string>& paths);

// Formats JSON for a file. Invalid UTF-8, for example in a driver's name, is replaced.
std::string text_of(const nlohmann::ordered_json& json);

}  // namespace mandelmarch::bench
