// SPDX-License-Identifier: Apache-2.0
#include "core/scene/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <map>
#include <optional>
#include <vector>

#include "core/text/error.h"
#include "core/text/number.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace {

constexpr std::size_t longest_word = 40;  // bytes of a word in a message

// Returns the words of a line without its comment, which begins with #.
std::vector<std::string_view> words_of(std::string_view line)
{
    line = line.substr(0, line.find('#'));
    std::vector<std::string_view> words;
    for (std::size_t from = line.find_first_not_of(blanks); from != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blanks, from), line.size());
        words.push_back(line.substr(from, end - from));
        from = line.find_first_not_of(blanks, end);
    }
    return words;
}

class LookReader {
public:
    explicit LookReader(const std::string& name) : name_(name) {}

    void read(std::string_view line)
    {
        ++number_;
        const std::vector<std::string_view> words = words_of(line);
        if (words.empty()) return;
        for (std::size_t i = 0; i < look_entries.size(); ++i) {
            if (look_entries.at(i).name != words[0]) continue;
            if (given_[i]) fail(fmt::format("{} is given twice", words[0]));
            given_[i] = true;
            return take(look_entries.at(i), words);
        }
        fail(fmt::format("'{}' given, expected an entry of a look, such as exposure",
                         printable(words[0], longest_word)));
    }

    LookValues result() const
    {
        for (std::size_t i = 0; i < look_entries.size(); ++i) {
            if (given_[i] || look_entries.at(i).ranges[0].low <= 0) continue;
            throw InputError(
                fmt::format("{}: the entry {} is missing, expected a look file", name_, look_entries.at(i).name));
        }
        return look_;
    }

private:
    [[noreturn]] void fail(const std::string& why) const
    {
        throw InputError(fmt::format("{}:{}: {}", name_, number_, why));
    }

    void take(const LookEntry& entry, const std::vector<std::string_view>& words)
    {
        const std::size_t count = entry.ranges.size();
        if (words.size() != count + 1) {
            fail(fmt::format("{} has {} numbers, expected {}", entry.name, words.size() - 1, count));
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto [low, high] = entry.ranges[i];
            const std::optional<double> value = parse_real(words[i + 1]);
            if (!value || *value < low || *value > high) {
                fail(fmt::format("{} has '{}', expected a number from {} to {}", entry.name,
                                 printable(words[i + 1], longest_word), low, high));
            }
            look_.numbers.at(place_in_look(entry.name) + i) = *value;
        }
    }

    const std::string& name_;
    int number_ = 0;  // number of the current line, from 1
    std::bitset<look_entries.size()> given_;
    LookValues look_;
};

}  // namespace

LookValues parse_look(std::string_view text, const std::string& name)
{
    LookReader reader(name);
    for (const std::string_view line : split(text, '\n')) reader.read(line);
    return reader.result();
}

const LookValues* look_named(std::string_view name)
{
    struct File {
        std::string_view name, text;
    };
    static const auto looks = [] {
        std::map<std::string, LookValues, std::less<>> all;
        for (const auto& [stem, text] : {
#include "looks.inc"
             }) {
            all.emplace(stem, parse_look(text, fmt::format("{}.look", stem)));
        }
        return all;
    }();
    const auto found = looks.find(name);
    return found == looks.end() ? nullptr : &found->second;
}

}  // namespace mandelmarch
