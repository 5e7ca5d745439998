// SPDX-License-Identifier: Apache-2.0
// Reads the project's own JSON files.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch {

// Returns the value that the text describes. Throws InputError if brackets are nested too deeply or an object has a key
// twice, and Json::exception if the text is not JSON. Messages of InputError begin with `name`.
template <class Json = nlohmann::json>
Json parse_json(const std::string& text, const std::string& name)
{
    struct Open {  // an object or a list whose end was not reached yet
        bool list = false;
        std::size_t count = 0;  // elements of a list so far
        std::set<std::string> keys = {};
        std::string key = {};  // the last one
    };
    std::vector<Open> open(1);
    using Event = typename Json::parse_event_t;
    check_json_depth(text, name);
    return Json::parse(text, [&](int, Event event, const Json& found) {
        if (event == Event::object_end || event == Event::array_end) open.pop_back();
        if (event == Event::object_end || event == Event::array_end || event == Event::value) ++open.back().count;
        if (event == Event::object_start || event == Event::array_start) open.push_back({event == Event::array_start});
        if (event != Event::key) return true;
        open.back().key = found.template get<std::string>();
        if (open.back().keys.insert(open.back().key).second) return true;
        std::string place;
        for (std::size_t i = 1; i < open.size(); ++i) {
            place += '/';
            place += open[i].list ? std::to_string(open[i].count) : printable(open[i].key, 80);
        }
        throw InputError(fmt::format("{}: the key {} is given twice, expected once", name, place));
    });
}

}  // namespace mandelmarch
