// SPDX-License-Identifier: Apache-2.0
#include "flight/audit/audit.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/scene/fractal.h"
#include "flight/audit/passages.h"
#include "flight/audit/standing.h"
#include "flight/audit/turns.h"
#include "flight/audit/view_rows.h"
#include "flight/plan/tour.h"

namespace mandelmarch {
namespace {

constexpr double solid = 1e-5;            // hull sizes: an estimate under it is inside solid
constexpr double turn_cap = 1.2;          // degrees a frame
constexpr double aside = 60;              // degrees off the motion
constexpr double stillness = 0.25;        // of the clearance: a camera that stays within it stands still
constexpr double official_frames = 7200;  // that the bar on passages is for

// Frames that have the same fractal constants one after another, with their field.
struct Run {
    std::size_t first, last;  // [first, last)
    std::unique_ptr<Field> field;
};

std::vector<Run> runs_of(const Path& path, int threads)
{
    const auto same = [](const Changes& a, const Changes& b) {
        return a.shape == b.shape && a.iterations == b.iterations && a.escape == b.escape;
    };
    std::vector<Run> runs;
    for (std::size_t i = 0; i < path.frames.size(); ++i) {
        if (i == 0 || !same(path.frames[i].changes, path.frames[i - 1].changes)) {
            runs.push_back({i, i, std::make_unique<Field>(scene_of(path, path.frames[i], 16, 9), threads)});
        }
        runs.back().last = i + 1;
    }
    return runs;
}

class Auditor {
public:
    Auditor(const Path& path, int threads, int stride)
        : path_(path), stride_(static_cast<std::size_t>(stride)), runs_(runs_of(path, threads))
    {
        for (const Frame& frame : path.frames) places_.push_back(frame.eye);
        clearances_.resize(places_.size());
        for (const Run& run : runs_) {
            run.field->distances(std::span(places_).subspan(run.first, run.last - run.first),
                                 std::span(clearances_).subspan(run.first, run.last - run.first));
        }
    }

    void promises()
    {
        const FlightBars& bars = path_.scene.fractal->flight.bars;
        solids();
        steps(bars.step);
        turns();
        standing();
    }

    void quality()
    {
        const FlightBars& bars = path_.scene.fractal->flight.bars;
        nearness();
        inside();
        const Field& field = *runs_.front().field;
        const auto passages = distinct_passages(field, places_, clearances_);
        add({"distinct passages", static_cast<double>(passages.size()),
             std::floor(bars.passages * static_cast<double>(places_.size()) / official_frames), false, false, "", ""});
        add({"frames at the cap on turning", percent(turned_at_cap_), 10, true, false, "%", ""});
        gazes(bars.aside);
        for (Row& row : jerk_rows(path_, clearances_)) add(std::move(row));
        views();
    }

    Audit take() { return std::move(audit_); }
    void add(Row row) { audit_.rows.push_back(std::move(row)); }

private:
    double size() const { return runs_.front().field->hull().size; }
    double percent(std::size_t count) const
    {
        return 100.0 * static_cast<double>(count) / static_cast<double>(places_.size());
    }
    static double seconds(std::size_t frames) { return static_cast<double>(frames) / frames_per_second; }

    // Between two frames the camera flies straight. Each sample's safe ball must reach the next sample.
    void solids()
    {
        std::size_t hits = 0;
        std::string worst;
        const auto hit = [&](std::size_t i) {
            if (hits++ == 0) worst = at_frame(i);
        };
        for (std::size_t r = 0; r < runs_.size(); ++r) {
            const Field& field = *runs_[r].field;
            const double floor = solid * field.hull().size;
            for (std::size_t i = runs_[r].first; i < runs_[r].last; ++i) {
                if (clearances_[i] <= floor) {
                    hit(i);
                } else if (i > 0) {
                    const double way = length(places_[i] - places_[i - 1]);
                    // Where the fractal changes between the frames, it is the later one's that is swept.
                    const bool reached = way <= field.safety() * clearances_[i];
                    if (!reached && field.least_between(places_[i], places_[i - 1], floor) <= floor) hit(i);
                }
            }
        }
        add({"frames inside solid, swept between frames", static_cast<double>(hits), 0, true, true, "", worst});
    }

    void steps(double bar)
    {
        double worst = 0;
        std::size_t where = 0;
        for (std::size_t i = 1; i < places_.size(); ++i) {
            const double step =
                length(places_[i] - places_[i - 1]) / std::max(std::min(clearances_[i], clearances_[i - 1]), 1e-300);
            if (step > worst) {
                worst = step;
                where = i;
            }
        }
        add({"largest step between frames / DE", worst, bar, true, true, "", at_frame(where)});
    }

    void turns()
    {
        const std::vector<double> turns = turns_of(path_);
        turned_at_cap_ =
            static_cast<std::size_t>(std::ranges::count_if(turns, [](double t) { return t > 0.98 * turn_cap; }));
        const auto most = std::ranges::max_element(turns);
        const double worst = *most;
        const auto where = static_cast<std::size_t>(most - turns.begin());
        add({"largest turn per frame", worst, turn_cap, true, true, "deg", at_frame(where)});
    }

    // The longest time that the camera stays within a quarter of its clearance of one place.
    void standing()
    {
        const double fastest = fastest_clearance(runs_.front().field->hull());
        std::vector<double> radii(clearances_.size());
        std::ranges::transform(clearances_, radii.begin(), [&](double c) { return stillness * std::min(c, fastest); });
        const Stand stand = longest_stand(places_, radii);
        add({"longest time standing still", seconds(stand.steps), 2, true, true, "s",
             stand.steps > 0 ? at_frame(stand.first) : ""});
    }

    void nearness()
    {
        const auto least = std::ranges::min_element(clearances_);
        add({"least DE, share of the hull's size", 100 * *least / size(), 0.25, false, false, "%",
             at_frame(static_cast<std::size_t>(least - clearances_.begin()))});
    }

    void inside()
    {
        std::size_t count = 0;
        for (const Run& run : runs_) {
            for (std::size_t i = run.first; i < run.last; ++i) count += run.field->hull().contains(places_[i]) ? 1 : 0;
        }
        add({"frames inside the hull", percent(count), 90, false, false, "%", ""});
    }

    void gazes(double bar)
    {
        std::size_t count = 0;
        for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
            const Vector motion = places_[i + 1] - places_[i];
            const Vector view = path_.frames[i].target - places_[i];
            const double product = length(motion) * length(view);
            if (product > 0 && dot(motion, view) < std::cos(aside * std::numbers::pi / 180) * product) ++count;
        }
        add({"frames looking more than 60 deg off the motion", percent(count), bar, true, false, "%", ""});
    }

    void views()
    {
        // Runs are short where the fractal changes in flight: there a view is taken of every frame of a run.
        Seen seen;
        for (const Run& run : runs_) {
            const auto part = views_of(*run.field, std::span(path_.frames).subspan(run.first, run.last - run.first),
                                       static_cast<int>(stride_));
            for (std::size_t i = 0; i < part.size(); ++i) seen.frames.push_back(run.first + i * stride_);
            seen.views.insert(seen.views.end(), part.begin(), part.end());
        }
        add(motion_row(path_, seen));
        for (Row& row : dull_rows(seen, clearances_, stride_)) add(std::move(row));
        for (Row& row : subject_rows(seen, stride_)) add(std::move(row));
        add(again_row(seen));
    }

    const Path& path_;
    std::size_t stride_;  // frames between the views that are looked at
    std::vector<Run> runs_;
    std::vector<Vector> places_;
    std::vector<double> clearances_;
    std::size_t turned_at_cap_ = 0;
    Audit audit_;
};

}  // namespace

bool Audit::promises_kept() const
{
    return std::ranges::all_of(rows, [](const Row& row) { return !row.promise || row.kept(); });
}

int Audit::bars_missed() const
{
    return static_cast<int>(std::ranges::count_if(rows, [](const Row& row) { return !row.kept(); }));
}

Audit audit(const Path& path, int threads, double planning, int stride)
{
    Auditor auditor(path, threads, stride);
    auditor.promises();
    auditor.quality();
    if (planning > 0)
        auditor.add({"planning", planning, path.scene.fractal->flight.bars.planning, true, false, "s", ""});
    return auditor.take();
}

Audit audit_promises(const Path& path, int threads)
{
    Auditor auditor(path, threads, 1);
    auditor.promises();
    return auditor.take();
}

}  // namespace mandelmarch
