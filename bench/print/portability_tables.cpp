// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "bench/print/printers.h"
#include "bench/result/portability.h"
#include "bench/statistics/table.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

// Returns all platforms, in the order of their numbers in the table.
std::vector<std::string> platforms_of(const std::vector<Portability>& portabilities)
{
    std::vector<std::string> found;
    const auto add = [&](const std::string& platform) {
        if (std::ranges::find(found, platform) == found.end()) found.push_back(platform);
    };
    for (const Portability& p : portabilities) {
        for (const OnPlatform& on : p.platforms) add(on.platform);
        for (const std::string& platform : p.not_measured) add(platform);
    }
    std::ranges::sort(found);
    return found;
}

// Returns the platforms of H, by their numbers in the table: "1,3".
std::string numbers_of(const Portability& p, const std::vector<std::string>& platforms)
{
    std::string text;
    for (std::size_t i = 0; i < platforms.size(); ++i) {
        const bool held = std::ranges::find(p.platforms, platforms[i], &OnPlatform::platform) != p.platforms.end();
        if (held) text += fmt::format("{}{}", text.empty() ? "" : ",", i + 1);
    }
    return text;
}

// Returns a line for each application and each platform on which the application was not measured, with the problems
// that are missing.
std::string not_measured(const std::vector<Portability>& portabilities)
{
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> problems;
    for (const Portability& p : portabilities) {
        for (const std::string& platform : p.not_measured) {
            std::vector<std::string>& of = problems[{p.application, platform}];
            if (std::ranges::find(of, p.problem) == of.end()) of.push_back(p.problem);
        }
    }
    std::string text;
    for (const auto& [where, of] : problems) {
        text += printable(fmt::format("{} was not measured on {}, which is not in its H: {}", where.first, where.second,
                                      fmt::join(of, ", ")),
                          longest_note) +
                "\n";
    }
    return text;
}

}  // namespace

std::string to_csv(const std::vector<Portability>& portabilities)
{
    std::string text = "problem,application,platform,fom,h\n";
    for (const Portability& p : portabilities) {
        std::string h;
        for (const OnPlatform& on : p.platforms) h += (h.empty() ? "" : "; ") + on.platform;
        for (const OnPlatform& on : p.platforms) {
            if (!(on.seconds > 0)) continue;
            text += fmt::format("{},{},{},{},{}\n",
                                csv_cell(problem_name(p.fractal, p.precision, p.mode, p.width, p.height)),
                                csv_cell(p.application), csv_cell(on.platform),
                                static_cast<double>(p.width) * p.height / on.seconds, csv_cell(h));
        }
    }
    return text;
}

std::string to_console(const std::vector<Portability>& portabilities)
{
    const std::vector<std::string> platforms = platforms_of(portabilities);
    std::string text = "H, the set of platforms:\n";
    for (std::size_t i = 0; i < platforms.size(); ++i) {
        text += fmt::format("  {}  {}\n", i + 1, printable(platforms[i], longest_note));
    }
    Table table({"<problem", "<precision", "<mode", "<backend", "<H", ">PP app", "<95 %", ">PP peak", "<95 %"});
    const auto three = [](double value) { return fmt::format("{:.3f}", value); };
    const auto interval = [](const Interval& i) { return fmt::format("[{:.3f}, {:.3f}]", i.low, i.high); };
    for (const Portability& p : portabilities) {
        if (p.platforms.empty()) continue;
        table.add(printable(p.problem, 100), name_of(p.precision), name_of(p.mode), printable(p.application, 100),
                  numbers_of(p, platforms), three(p.application_portability), interval(p.application_interval),
                  p.architecture_portability ? three(*p.architecture_portability) : "-",
                  p.architecture_interval ? interval(*p.architecture_interval) : "");
    }
    return text + table.text() +
           "PP app: 1 for a backend that is the fastest on every platform of H; 0: unavailable on one, or a wrong "
           "picture\n"
           "PP peak: -: the peak of a platform of H was not measured\n" +
           not_measured(portabilities);
}

}  // namespace mandelmarch::bench
