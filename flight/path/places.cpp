// SPDX-License-Identifier: Apache-2.0
#include "flight/path/places.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "core/os/input_file.h"
#include "core/text/error.h"
#include "core/text/number.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace {

constexpr std::size_t columns = 10;
constexpr std::size_t needed = 6;  // the first of the columns; a table may lack the others
constexpr std::size_t most_places = 1000;
constexpr std::size_t longest_field = 80;  // bytes of a field in a message
constexpr double farthest = 1e9;           // largest coordinate
constexpr double latest = 1e6;             // seconds
constexpr double least_lens = 0.1, most_lens = 2;
using Fields = std::array<std::string, columns>;
constexpr std::string_view tour_word = "tour";
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

class PlacesReader {
public:
    explicit PlacesReader(const std::string& name)
    {
        places_.file = name;
        names_ = fields_of(places_header, ',');
    }

    // Reads a line. Faults of lines below the header are collected for take().
    void read(std::string_view line)
    {
        ++number_;
        const bool below = separator_ != 0;
        try {
            read_fields(line);
        } catch (const InputError& fault) {
            if (!below) throw;
            faults_.emplace_back(fault.what());
        }
    }

    Places take()
    {
        number_ = std::max(number_, 1);
        if (separator_ == 0) fail_head("the table is empty");
        refuse_faults(faults_);
        if (places_.all.empty()) {
            throw InputError(fmt::format("{}: no places, expected lines below the header", places_.file));
        }
        return std::move(places_);
    }

private:
    void read_fields(std::string_view line)
    {
        if (trimmed(line).empty() || trimmed(line).front() == '#') return;
        if (separator_ == 0) return head(line);
        const std::vector<std::string> given = fields_of(line, separator_);
        if (given.size() > order_.size()) {
            fail(fmt::format("{} fields given, expected {} or the word {}", given.size(), order_.size(), tour_word));
        }
        Fields fields;
        for (std::size_t i = 0; i < given.size(); ++i) {
            if (order_[i] < columns) fields[order_[i]] = given[i];
        }
        const auto empty = static_cast<std::size_t>(std::ranges::count(fields, ""));
        if (empty == columns) return;
        if (empty == columns - 1 && std::ranges::count(fields, tour_word) == 1) {
            if (places_.tour_after) fail("this is the second tour on end, expected a place between two tours");
            places_.tour_after = true;
            return;
        }
        if (places_.all.size() == most_places) fail(fmt::format("expected at most {} places", most_places));
        add(fields);
    }

    [[noreturn]] void fail(const std::string& why) const
    {
        throw InputError(fmt::format("{}:{}: {}", places_.file, number_, why));
    }

    [[noreturn]] void fail_head(const std::string& found) const
    {
        fail(fmt::format("{}, expected the header {}", found, places_header));
    }

    // Returns the fields of a line, without quotes, and without blanks around them. Fields that are empty at the
    // line's end are left out.
    std::vector<std::string> fields_of(std::string_view line, char separator) const
    {
        std::vector<std::string> fields(1);
        bool quoted = false;
        for (const char c : line) {
            if (c == '"') {
                quoted = !quoted;
            } else if (c == separator && !quoted) {
                fields.emplace_back();
            } else {
                // In tables with semicolons or tabs, spreadsheets of many countries write decimal commas.
                fields.back() += c == ',' && separator != ',' ? '.' : c;
            }
        }
        if (quoted) fail("a quotation mark is open at the line's end, expected one more");
        for (std::string& field : fields) field = std::string(trimmed(field));
        while (!fields.empty() && fields.back().empty()) fields.pop_back();
        return fields;
    }

    // Reads the names of the columns, in any order. Columns without a name are skipped.
    void head(std::string_view line)
    {
        for (const char separator : {',', ';', '\t'}) {
            std::vector<std::string> names = fields_of(line, separator);
            for (std::string& name : names) {
                std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
            }
            if (std::ranges::count(names, names_[0]) == 0) continue;
            separator_ = separator;
            for (const std::string& name : names) {
                const auto found = std::ranges::find(names_, name);
                if (!name.empty() && found == names_.end()) {
                    fail_head(fmt::format("unknown column '{}'", printable(name, longest_field)));
                }
                order_.push_back(static_cast<std::size_t>(found - names_.begin()));
            }
            for (std::size_t column = 0; column < columns; ++column) {
                const auto times = std::ranges::count(order_, column);
                if (times > 1) fail_head(fmt::format("column {} given {} times", names_[column], times));
                if (times == 0 && column < needed) fail_head(fmt::format("column {} is missing", names_[column]));
            }
            return;
        }
        fail_head(fmt::format("'{}' given", printable(trimmed(line), longest_field)));
    }

    double real(const Fields& fields, std::size_t column, double low, double high) const
    {
        const auto value = parse_real(fields[column]);
        if (value && *value >= low && *value <= high) return *value;
        fail(fmt::format("{} is '{}', expected a number from {} to {}", names_[column],
                         printable(fields[column], longest_field), low, high));
    }

    void add(const Fields& fields)
    {
        const auto point = [&](std::size_t first) {
            const double x = real(fields, first, -farthest, farthest);
            const double y = real(fields, first + 1, -farthest, farthest);
            return Vector{x, y, real(fields, first + 2, -farthest, farthest)};
        };
        Place place;
        place.tour = std::exchange(places_.tour_after, false);
        place.eye = point(0);
        place.target = point(3);
        if (!(length(place.target - place.eye) > 0)) fail("look_at is the location, expected another point");
        if (!fields[6].empty()) place.second = real(fields, 6, 0, latest);
        place.stay = fields[7].empty() ? usual_stay : real(fields, 7, 0, most_stay);
        if (!fields[8].empty()) place.lens = real(fields, 8, least_lens, most_lens);
        if (!fields[9].empty()) place.roll = real(fields, 9, -180, 180);
        place.line = number_;
        if (place.tour && place.second == 0) fail("second is 0, expected a later one after a tour");
        in_time(place);
        if (place.second) {
            latest_ = *place.second + place.stay;
        } else {
            latest_ += place.stay;
        }
        places_.all.push_back(place);
    }

    // Throws InputError if the camera must be at the place before it leaves an earlier place.
    void in_time(const Place& place) const
    {
        if (!place.second || places_.all.empty() || *place.second > latest_) return;
        fail(fmt::format("second is {}, expected more than {}, when the stays before it end", *place.second, latest_));
    }

    Places places_;
    std::vector<std::string> names_;  // of the columns, in the order of Fields
    std::vector<std::size_t> order_;  // the column of each of the table's fields; `columns` if it has no name
    int number_ = 0;                  // number of the present line, from 1
    char separator_ = 0;              // 0: the header is not read yet
    std::vector<std::string> faults_;
    double latest_ = 0;  // seconds; earliest end of the stay at the last place
};

}  // namespace

void refuse_faults(std::vector<std::string> faults)
{
    constexpr std::size_t most = 3;
    if (faults.empty()) return;
    if (faults.size() > most) {
        faults.resize(most);
        faults.emplace_back("and more");
    }
    throw InputError(fmt::format("{}", fmt::join(faults, "; ")));
}

std::string place_line(const Place& place)
{
    const auto& [eye, target] = std::pair(place.eye, place.target);
    return fmt::format("{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},,{},{:.4g},{:.4g}", eye.x, eye.y, eye.z,
                       target.x, target.y, target.z, usual_stay, place.lens, place.roll);
}

Places places_from_text(const std::string& text, const std::string& name)
{
    PlacesReader reader(name);
    std::string_view rest = text;
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    if (rest.starts_with("\xff\xfe") || rest.starts_with("\xfe\xff") || rest.find('\0') != std::string_view::npos) {
        throw InputError(fmt::format("{}: UTF-16 or no text, expected a table in UTF-8", name));
    }
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
        reader.read(rest.substr(0, end));
        rest.remove_prefix(end);
        rest.remove_prefix(std::min<std::size_t>(rest.starts_with("\r\n") ? 2 : 1, rest.size()));
    }
    return reader.take();
}

Places read_places(const std::string& file) { return places_from_text(text_of_file(file, "places file"), file); }

}  // namespace mandelmarch
