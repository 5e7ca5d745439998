// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/scene/fractal.h"
#include "core/text/version.h"
#include "flight/audit/motion.h"
#include "flight/audit/views.h"
#include "flight/field/threads.h"
#include "flight/path/measures.h"

namespace mandelmarch {
namespace {

constexpr double most_wall_step = 0.25;   // clearances per frame; limit on the change of DE caused by a changing shape
constexpr double turn_cap = 1.2;          // degrees per frame; largest turn of the camera
constexpr double aside = 60;              // degrees between gaze and motion; a larger angle counts as looking aside
constexpr double stillness = 0.25;        // clearances; a camera that stays within this radius stands still
constexpr double official_seconds = 240;  // seconds; flight time to which the threshold of passages applies

class Auditor {
public:
    Auditor(const Path& path, int threads, int stride)
        : path_(path),
          stride_(static_cast<std::size_t>(stride)),
          measures_(flight_measures(*path.scene.fractal)),
          runs_(path, threads),
          places_(runs_.places()),
          clearances_(runs_.clearances())
    {
    }

    void promises()
    {
        solids();
        steps();
        if (runs_.changes()) walls();
        turns();
        standing();
    }

    void quality()
    {
        nearness();
        inside();
        add({"distinct passages", static_cast<double>(runs_.passages().size()),
             std::floor(measures_.passages * seconds(places_.size()) / official_seconds), false, false, ""});
        add({"frames at the cap on turning", percent(turned_at_cap_), 10, true, false, "%"});
        gazes();
        for (Row& row : jerk_rows(path_, clearances_)) add(std::move(row));
        add(level_row(path_));
        views();
    }

    Audit take() { return std::move(audit_); }
    void add(Row row) { audit_.rows.push_back(std::move(row)); }

private:
    const Bounds& bounds(std::size_t frame) const { return runs_.field(frame).bounds(); }
    double percent(std::size_t count) const
    {
        return 100.0 * static_cast<double>(count) / static_cast<double>(places_.size());
    }
    double seconds(std::size_t frames) const { return static_cast<double>(frames) / path_.frames_per_second; }
    // Converts a threshold per frame, given for the frame rate of planning, to the path's frame rate.
    double by_rate(double bar) const
    {
        return bar * (static_cast<double>(frames_per_second) / path_.frames_per_second);
    }

    void solids()
    {
        std::vector<char> hit(places_.size(), 0);
        parallel(places_.size(), 64, runs_.threads(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const bool inside = clearances_[i] <= in_solid * bounds(i).size;
                hit[i] = inside || (i > 0 && !runs_.free_before(i)) ? 1 : 0;
            }
        });
        const auto worst = std::ranges::find(hit, 1) - hit.begin();
        const auto hits = std::ranges::count(hit, 1);
        add({"frames inside solid, swept between frames", static_cast<double>(hits), 0, true, true, "",
             hits > 0 ? std::optional<std::size_t>(worst) : std::nullopt});
    }

    // Adds an item whose value is the largest of the frames' values.
    void add_largest(const char* name, const std::vector<double>& values, double bar, const char* unit)
    {
        const auto worst = std::ranges::max_element(values);
        add({name, *worst, bar, true, true, unit, static_cast<std::size_t>(worst - values.begin())});
    }

    void steps()
    {
        std::vector<double> steps(places_.size(), 0);
        for (std::size_t i = 1; i < places_.size(); ++i) {
            steps[i] =
                length(places_[i] - places_[i - 1]) / std::max(std::min(clearances_[i], clearances_[i - 1]), 1e-300);
        }
        add_largest("largest step between frames / DE", steps, by_rate(measures_.step), "");
    }

    // Adds the largest relative change of DE from one frame to the next that is due to the change of the shape alone.
    void walls()
    {
        std::vector<double> steps(places_.size(), 0);
        parallel(places_.size(), 64, runs_.threads(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) steps[i] = runs_.wall_step(i);
        });
        add_largest("largest change of DE between frames by the shape / DE", steps, by_rate(most_wall_step), "");
    }

    void turns()
    {
        const std::vector<double> turns = turns_of(path_);
        const double cap = by_rate(turn_cap);
        turned_at_cap_ =
            static_cast<std::size_t>(std::ranges::count_if(turns, [cap](double t) { return t > 0.98 * cap; }));
        add_largest("largest turn per frame", turns, cap, "deg");
    }

    // Adds the longest time during which the camera stays within a radius of one point. The radius is a quarter of the
    // clearance at that point; a clearance above fastest_clearance() counts as fastest_clearance().
    void standing()
    {
        std::vector<double> radii(clearances_.size());
        for (std::size_t i = 0; i < radii.size(); ++i)
            radii[i] = stillness * std::min(clearances_[i], fastest_clearance(bounds(i)));
        const Stand stand = longest_stand(places_, radii);
        add({"longest time standing still", seconds(stand.steps), 2, true, true, "s",
             stand.steps > 0 ? std::optional(stand.first) : std::nullopt});
    }

    void nearness()
    {
        std::vector<double> shares(clearances_.size());
        for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = 100 * clearances_[i] / bounds(i).size;
        const auto least = std::ranges::min_element(shares);
        add({"least DE, share of the hull's size", *least, 0.25, false, false, "%",
             static_cast<std::size_t>(least - shares.begin())});
    }

    void inside()
    {
        std::size_t count = 0;
        for (std::size_t i = 0; i < places_.size(); ++i) count += bounds(i).contains(places_[i]) ? 1 : 0;
        add({"frames inside the hull", percent(count), 90, false, false, "%"});
    }

    void gazes()
    {
        std::size_t count = 0;
        for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
            const Vector motion = places_[i + 1] - places_[i];
            const Vector view = path_.frames[i].target - places_[i];
            const double product = length(motion) * length(view);
            if (product > 0 && dot(motion, view) < std::cos(aside * std::numbers::pi / 180) * product) ++count;
        }
        add({"frames looking more than 60 deg off the motion", percent(count), measures_.aside, true, false, "%"});
    }

    void views()
    {
        Seen seen{.frames_per_second = path_.frames_per_second, .frames = {}, .views = {}};
        for (std::size_t i = 0; i < places_.size(); i += stride_) seen.frames.push_back(i);
        seen.views.resize(seen.frames.size());
        parallel(seen.frames.size(), 16, runs_.threads(), [&](std::size_t first, std::size_t last) {
            // Consecutive views of the same shape are computed together.
            for (std::size_t v = first; v < last;) {
                const DistanceField& field = runs_.field(seen.frames[v]);
                const auto to = seen.views.begin() + static_cast<std::ptrdiff_t>(v);
                std::vector<Frame> frames;
                for (; v < last && &runs_.field(seen.frames[v]) == &field; ++v)
                    frames.push_back(path_.frames[seen.frames[v]]);
                std::ranges::copy(views_of(field, frames), to);
            }
        });
        add(motion_row(path_, seen, runs_.threads()));
        for (Row& row : dull_rows(seen, clearances_, stride_, runs_.threads())) add(std::move(row));
        for (Row& row : subject_rows(seen, stride_)) add(std::move(row));
        again(repeated_views(seen, runs_.threads()));
    }

    void again(const std::vector<Repeated>& views)
    {
        for (const Repeated& view : views) audit_.repeated.push_back(view.later);
        add({"the same view again within a minute",
             static_cast<double>(views.size()),
             0,
             true,
             false,
             "",
             {},
             views.empty() ? "" : fmt::format("frames {} and {}", views[0].frame, views[0].later)});
    }

    const Path& path_;
    std::size_t stride_;  // frames from one view to the next
    FlightMeasures measures_;
    Runs runs_;
    const std::vector<Vector>& places_;
    const std::vector<double>& clearances_;
    std::size_t turned_at_cap_ = 0;
    Audit audit_;
};

}  // namespace

std::string Row::worst() const { return frame ? fmt::format("frame {}", *frame) : note; }

bool Audit::promises_kept() const
{
    return std::ranges::all_of(rows, [](const Row& row) { return !row.promise || row.kept(); });
}

int Audit::bars_missed() const
{
    return static_cast<int>(std::ranges::count_if(rows, [](const Row& row) { return !row.kept(); }));
}

double Audit::faults() const
{
    double sum = 0;
    for (const Row& row : rows) {
        if (row.kept()) continue;
        const double by = std::abs(row.value - row.bar) / std::max(std::abs(row.bar), 1.0);
        sum += (row.promise ? broken_promise : 1) * (1 + std::min(by, 5.0));
    }
    return sum;
}

std::string Audit::missed(bool promises) const
{
    std::string items;
    for (const Row& row : rows) {
        if (row.kept() || (promises && !row.promise)) continue;
        items += fmt::format("{}{} ({:.4g} {} {:.4g}{}{})", items.empty() ? "" : ", ", row.name, row.value,
                             row.at_most ? ">" : "<", row.bar, row.unit.empty() ? "" : " ", row.unit);
    }
    return items.empty() ? "nothing" : items;
}

Audit audit(const Path& path, int threads, int stride)
{
    Auditor auditor(path, threads, stride);
    auditor.promises();
    auditor.quality();
    return auditor.take();
}

Audit audit_promises(const Path& path, int threads)
{
    Auditor auditor(path, threads, 1);
    auditor.promises();
    return auditor.take();
}

std::string table_of(const Path& path, const Audit& audit)
{
    std::string text = fmt::format("{}, seed {}, {} frames ({:.1f} s); ! is a promise, the others are quality\n",
                                   path.scene.fractal->name, path.seed, path.frames.size(),
                                   static_cast<double>(path.frames.size()) / path.frames_per_second);
    for (const Row& row : audit.rows) {
        const auto value = [&](double v) {
            return fmt::format("{:.4g}{}{}", v, row.unit.empty() ? "" : " ", row.unit);
        };
        text += fmt::format("{} {:<54} {:>10}  {} {:<8} {}{}{}\n", row.promise ? '!' : ' ', row.name, value(row.value),
                            row.at_most ? "<=" : ">=", value(row.bar),
                            row.kept()    ? "kept"
                            : row.promise ? "BROKEN"
                                          : "missed",
                            row.worst().empty() ? "" : "  ", row.worst());
    }
    return text;
}

std::string json_of(const Path& path, const Audit& audit, double planning)
{
    nlohmann::ordered_json json{{"schema", 1},
                                {"program", version_line("flythrough")},
                                {"fractal", path.scene.fractal->name},
                                {"seed", path.seed},
                                {"frames", path.frames.size()},
                                {"planning_seconds", planning},
                                {"promises_kept", audit.promises_kept()},
                                {"bars_missed", audit.bars_missed()},
                                {"rows", nlohmann::ordered_json::array()}};
    for (const Row& row : audit.rows) {
        json["rows"].push_back({{"name", row.name},
                                {"value", row.value},
                                {"bar", row.bar},
                                {"at_most", row.at_most},
                                {"promise", row.promise},
                                {"unit", row.unit},
                                {"kept", row.kept()},
                                {"worst", row.worst()}});
    }
    return json.dump(2) + "\n";
}

}  // namespace mandelmarch
