// SPDX-License-Identifier: Apache-2.0
#include "bench/result/differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<const char*, const char*>, 18> facts{{{"revision", "/git/revision"},
                                                                     {"changed since the revision", "/git/dirty"},
                                                                     {"version", "/build/version"},
                                                                     {"build type", "/build/type"},
                                                                     {"compiler", "/build/compiler"},
                                                                     {"compiler flags", "/build/flags"},
                                                                     {"CPU", "/cpu/model"},
                                                                     {"CPU", "/cpu/platform"},
                                                                     {"stepping", "/cpu/stepping"},
                                                                     {"caches", "/cpu/caches"},
                                                                     {"usable cores", "/cpu/cores_usable"},
                                                                     {"governor", "/cpu/governor"},
                                                                     {"turbo disabled", "/cpu/turbo_disabled"},
                                                                     {"memory, bytes", "/memory/total_bytes"},
                                                                     {"microcode", "/cpu/microcode"},
                                                                     {"system", "/os/name"},
                                                                     {"kernel", "/os/kernel"},
                                                                     {"variables", "/variables"}}};

std::string words(const Json& value)
{
    if (value.is_null()) return "unknown";
    return printable(value.is_string() ? value.get<std::string>() : value.dump(), 200);
}

// Returns the CPU flags in `flags` that are not in `others`, separated by spaces; "none" if there are none.
std::string only_in(const Json& flags, const Json& others)
{
    std::string only;
    for (const Json& flag : flags) {
        if (std::ranges::find(others, flag) != others.end()) continue;
        if (!only.empty()) only += ' ';
        only += words(flag);
    }
    return only.empty() ? "none" : printable(only, 200);
}

// Returns the compilers, flags and drivers of the backends. The keys are their names in messages: "compiler of openmp".
std::map<std::string, Json> backends_of(const Json& environment)
{
    std::map<std::string, Json> found;
    for (const Json& backend : value_at(environment, "/backends")) {
        const std::string name = words(value_at(backend, "/name"));
        for (const char* part : {"compiler", "flags_exact", "flags_fast"}) {
            found[fmt::format("{} of {}", part, name)] = value_at(backend, fmt::format("/{}", part));
        }
        int index = 0;
        for (const Json& device : value_at(backend, "/devices")) {
            found[fmt::format("driver of {} {}", name, index++)] = value_at(device, "/driver");
        }
    }
    return found;
}

}  // namespace

Json value_at(const Json& environment, const std::string& pointer)
{
    const Json::json_pointer place(pointer);
    return environment.contains(place) ? environment.at(place) : Json();
}

bool same_fact(const Json& one, const Json& other)
{
    const auto sorted = [](const Json& fact) {
        nlohmann::json made = fact;  // its keys are sorted
        if (made.is_array()) std::sort(made.begin(), made.end());
        return made;
    };
    return sorted(one) == sorted(other);
}

std::vector<std::string> differences_of(const Json& old_environment, const Json& new_environment)
{
    std::vector<std::string> lines;
    const auto look = [&](const std::string& what, const Json& before, const Json& after) {
        if (same_fact(before, after)) return;
        lines.push_back(fmt::format("{}: {} in the old result, {} in the new", what, words(before), words(after)));
    };
    for (const auto& [what, pointer] : facts) {
        look(what, value_at(old_environment, pointer), value_at(new_environment, pointer));
    }
    const Json old_flags = value_at(old_environment, "/cpu/flags");
    const Json new_flags = value_at(new_environment, "/cpu/flags");
    if (old_flags.is_array() && new_flags.is_array() && !same_fact(old_flags, new_flags)) {
        lines.push_back(fmt::format("CPU flags: {} in the old result only, {} in the new only",
                                    only_in(old_flags, new_flags), only_in(new_flags, old_flags)));
    }
    // Backends and devices that only one result has are skipped, because the table of configurations shows them.
    const std::map<std::string, Json> before = backends_of(old_environment);
    for (const auto& [what, value] : backends_of(new_environment)) {
        if (const auto found = before.find(what); found != before.end()) look(what, found->second, value);
    }
    return lines;
}

}  // namespace mandelmarch::bench
