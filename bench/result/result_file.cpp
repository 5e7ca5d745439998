// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "bench/result/figures.h"
#include "bench/result/portability.h"
#include "bench/result/result_fields.h"
#include "bench/result/result_file.h"
#include "core/os/input_file.h"
#include "core/text/error.h"
#include "core/text/json.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

constexpr std::size_t one_liner = -1;  // depth of a value that takes one line
constexpr std::string_view result_kind = "result file of bench --json";

Json parsed(const std::string& text, const std::string& name)
{
    try {
        return parse_json<Json>(text, name);
    } catch (const Json::exception&) {
        throw InputError(name + ": not JSON, expected a result file of bench --json");
    }
}

// Throws Refusal if two configurations have the same name, or if operation counts have no lane utilisation.
void check(const Result& result)
{
    std::set<std::string> names;
    for (const Row& row : result.rows) {
        if (!names.insert(row.name()).second) throw Refusal{"rows", printable(row.name(), 200) + " is there twice"};
    }
    for (std::size_t i = 0; i < result.counts.size(); ++i) {
        if (result.counts[i].lane_use.empty()) {
            throw Refusal{fmt::format("counts[{}].lane_use", i), "[] given, expected the use of some lanes"};
        }
    }
}

// Formats JSON. Plain values that follow each other share a line, and so do all samples of a row; other values take a
// line for each element.
std::string lines_of(const Json& json, std::string_view key, std::size_t depth)
{
    const auto plain = [](const Json& element) { return !element.is_structured() || element.empty(); };
    if (plain(json)) return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    const bool one_line = key == "samples" || depth == one_liner || std::ranges::all_of(json, plain);
    const std::size_t inner = one_line ? one_liner : depth + 1;
    std::string text;
    bool after_plain = false;
    for (const auto& [name, element] : json.items()) {
        const bool new_line = !one_line && !(after_plain && plain(element));
        if (!text.empty()) text += new_line ? "," : ", ";
        if (new_line) text += "\n" + std::string(inner, ' ');
        if (json.is_object()) text += lines_of(name, "", one_liner) + ": ";
        text += lines_of(element, name, inner);
        after_plain = plain(element);
    }
    if (!one_line) text += "\n" + std::string(depth, ' ');
    return fmt::format("{}{}{}", json.is_object() ? '{' : '[', text, json.is_object() ? '}' : ']');
}

}  // namespace

Json facts_of(const Result& result) { return document(result, Form::facts); }

Json json_of(const Result& result) { return document(result, Form::derived); }

Json json_of(const std::vector<Portability>& portabilities)
{
    Json list = Json::array();
    for (const Portability& p : portabilities) {
        if (!p.platforms.empty()) list.push_back(to_json(p, Form::derived));
    }
    return list;
}

Result result_from_json(const Json& json, const std::string& name)
{
    return derived(record_of<Result>(json, name, check));
}

Result parse_result(const std::string& text, const std::string& name)
{
    return result_from_json(parsed(text, name), name);
}

Json json_in(const std::string& path) { return parsed(text_of_file(path, result_kind), path); }

Result read_result(const std::string& path) { return result_from_json(json_in(path), path); }

std::optional<Result> read_if_result(const std::string& path)
{
    const Json json = parsed(text_of_file(path, result_kind), path);
    return schema_in(json) == result_schema ? std::optional(result_from_json(json, path)) : std::nullopt;
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

std::string text_of(const Json& json) { return lines_of(json, "", 0) + "\n"; }

}  // namespace mandelmarch::bench
