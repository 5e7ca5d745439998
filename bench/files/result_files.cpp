// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "bench/files/fields.h"
#include "bench/files/result_file.h"
#include "bench/files/version1.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

std::string text_of_file(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(path + ": cannot be read, expected a result file of bench --json");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace

Result read_result(const std::string& path) { return parse_result(text_of_file(path), path); }

std::optional<Result> read_if_result(const std::string& path)
{
    const std::string text = text_of_file(path);
    check_json_depth(text, path);
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || json.value("schema", Json()) != result_schema) return std::nullopt;
    return result_from_json(json, path);
}

nlohmann::ordered_json upgraded_json(const std::string& path)
{
    const std::string text = text_of_file(path);
    check_json_depth(text, path);
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.value("schema", Json()).is_string()) {
        throw InputError(path + ": not a file of bench, expected a result of --json");
    }
    if (json["schema"] == result_schema) return json_of(result_from_json(json, path));
    upgrade(json);
    return json;
}

std::vector<std::string> result_files(const std::vector<std::string>& paths)
{
    namespace fs = std::filesystem;
    std::vector<std::string> files;
    for (const std::string& path : paths) {
        std::error_code error;
        if (!fs::is_directory(path, error)) {
            files.push_back(path);
            continue;
        }
        std::vector<std::string> found;
        for (const auto& entry : fs::recursive_directory_iterator(path, error)) {
            if (entry.path().extension() == ".json") found.push_back(entry.path().string());
        }
        if (error) throw InputError(fmt::format("{}: cannot be read: {}", path, error.message()));
        std::ranges::sort(found);
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

}  // namespace mandelmarch::bench
