// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/frame_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/base/cpu.h"
#include "core/base/version.h"

namespace mandelmarch::explore {
namespace {

using Json = nlohmann::ordered_json;

constexpr double graph = 10;         // seconds that the graph of frame times shows
constexpr double screen = 1.0 / 60;  // duration of a screen frame at 60 Hz, seconds

// Returns a percentile of the values by the nearest-rank method; 0 if there are no values.
double percentile(std::vector<double> values, double percent)
{
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const auto rank = static_cast<std::size_t>(std::ceil(percent / 100 * static_cast<double>(values.size())));
    return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

Json percentiles(const std::vector<double>& values, double unit)
{
    Json json;
    for (const int p : {50, 90, 95, 99, 100}) json[fmt::format("p{}", p)] = unit * percentile(values, p);
    return json;
}

}  // namespace

void FrameStatistics::begin(const std::string& name)
{
    sections_.push_back({name, {}, {}});
    asked_.clear();
    on_ = true;
}

void FrameStatistics::end() { on_ = false; }

void FrameStatistics::asked(std::uint64_t view, std::uint64_t frame)
{
    if (on_) asked_.emplace_back(view, frame);
}

void FrameStatistics::shown(std::uint64_t view, std::uint64_t frame)
{
    while (on_ && !asked_.empty() && asked_.front().first <= view) {
        sections_.back().latencies.push_back(static_cast<double>(frame - asked_.front().second + 1));
        asked_.pop_front();
    }
}

void FrameStatistics::note(const FrameTiming& frame)
{
    last_.push_back(static_cast<float>(frame.interval));
    last_seconds_ += frame.interval;
    while (last_.size() > 1 && last_seconds_ > graph) {
        last_seconds_ -= static_cast<double>(last_.front());
        last_.pop_front();
    }
    if (on_) sections_.back().frames.push_back(frame);
}

std::string FrameStatistics::json(std::pair<int, int> window, const std::string& how, double rate,
                                  const Pane& pane) const
{
    Json sections = Json::array();
    for (const Section& section : sections_) {
        std::vector<double> seconds;
        std::vector<double> intervals;
        std::vector<double> drawing;
        std::vector<double> showing;
        std::vector<double> shares;
        double within = 0;
        for (const FrameTiming& frame : section.frames) {
            seconds.push_back(frame.seconds);
            intervals.push_back(frame.interval);
            showing.push_back(frame.showing);
            within += frame.seconds <= screen ? 1 : 0;
            if (frame.drawing <= 0) continue;
            drawing.push_back(frame.drawing);
            shares.push_back(frame.share);
        }
        const double count = std::max<double>(1, static_cast<double>(seconds.size()));
        const double total = std::accumulate(intervals.begin(), intervals.end(), 0.0);
        sections.push_back({{"name", section.name},
                            {"frames", seconds.size()},
                            {"pictures", drawing.size()},
                            {"pictures_per_second", total > 0 ? static_cast<double>(drawing.size()) / total : 0},
                            {"within_16_7_ms", within / count},
                            {"frame_ms", percentiles(seconds, 1e3)},
                            {"interval_ms", percentiles(intervals, 1e3)},
                            {"drawing_ms", percentiles(drawing, 1e3)},
                            {"showing_ms", percentiles(showing, 1e3)},
                            {"latency_frames", percentiles(section.latencies, 1)},
                            {"share_of_pixels", percentiles(shares, 1)}});
    }
    const Json json{{"schema", 1},
                    {"kind", "explore"},
                    {"program", version_line("explore")},
                    {"cpu", cpu_name()},
                    {"window", {window.first, window.second}},
                    {"shown_by", how},
                    {"screen_rate", rate},
                    {"drawn_by", name_of(pane.setup)},
                    {"threads", pane.report.threads},
                    {"pack", pane.report.pack},
                    {"instruction_set", pane.report.instruction_set},
                    {"sections", sections}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mandelmarch::explore
