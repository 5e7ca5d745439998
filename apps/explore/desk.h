// SPDX-License-Identifier: Apache-2.0
// The path that is recorded, opened or planned: where it is played, its audit, and what is done with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/explore/setup.h"
#include "apps/explore/task.h"
#include "core/render/registry.h"
#include "flight/audit/audit.h"
#include "flight/path/path.h"

namespace mandelmarch::explore {

class Desk {
public:
    bool recording() const { return recording_; }
    bool playing = false;

    bool has_path() const { return path_.frames.size() > 1; }
    const Path& path() const { return path_; }
    std::size_t frames() const { return path_.frames.size(); }
    double at() const { return at_; }  // frames
    void go_to(double frame);
    // Plays on; at the end it stops.
    void advance(double seconds);
    // The picture there, for a window of this size.
    Scene scene(int width, int height) const;

    void open(const std::string& file);  // throws InputError
    void save(const std::string& file) const;
    void take(Path path);

    void begin_recording(const Scene& scene);
    // The camera after so many seconds more.
    void record(const Scene& scene, double seconds);
    void end_recording();

    void smooth() { take(smoothed_path()); }
    void cut_before();
    void cut_after();
    void put_camera(const Scene& scene);

    // A tour of the scene's fractal; take_news() tells when it is there.
    void plan(const Scene& scene, std::uint64_t seed, int frames);
    void film(const Registry& registry, const Setup& setup, const std::string& file, int width, int height);
    bool planning() const { return planning_.running(); }
    bool filming() const { return filming_.running(); }

    // Rows of the path as it is; `stale`: of an earlier state of it.
    const std::vector<Row>& rows() const { return rows_; }
    bool stale() const { return audited_ != version_; }
    // Audits what has changed, by and by; what has come of plans and films, in words for the user, or "".
    std::string take_news();
    // The frame at which the next broken promise or missed bar is worst, after where the path is; nullopt: none is.
    std::optional<std::size_t> next_broken() const;
    // All rows, those of quality too: seconds of work.
    void audit_all()
    {
        whole_audit_ = true;
        audited_ = 0;
    }

private:
    Path smoothed_path() const;
    void changed();

    Path path_;
    double at_ = 0;
    bool recording_ = false;
    double owed_ = 0;  // seconds recorded since the last frame
    std::uint64_t version_ = 1, audited_ = 0, auditing_ = 0;
    bool whole_audit_ = false;
    std::vector<Row> rows_;
    Task<Audit> audit_;
    Task<Path> planning_;
    Task<std::string> filming_;
};

}  // namespace mandelmarch::explore
