// SPDX-License-Identifier: Apache-2.0
// The path editor: records, opens, plans, plays, edits and audits a path, and renders it as a film.
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

class PathEditor {
public:
    bool recording() const { return recording_; }
    bool playing = false;

    bool has_path() const { return path_.frames.size() > 1; }
    const Path& path() const { return path_; }
    std::size_t frames() const { return path_.frames.size(); }
    double at() const { return at_; }  // position, frames
    void go_to(double frame);
    // Moves the position forwards; stops playing at the end.
    void advance(double seconds);
    // Returns the scene at the position, for a window of this size.
    Scene scene(int width, int height) const;

    void open(const std::string& file);  // throws InputError
    void save(const std::string& file) const;
    void take(Path path);

    void begin_recording(const Scene& scene);
    // Records the camera, `seconds` after the previous call.
    void record(const Scene& scene, double seconds);
    void end_recording();

    void smooth() { take(smoothed_path()); }
    void cut_before();
    void cut_after();
    void put_camera(const Scene& scene);

    // Plans a tour of the scene's fractal in the background; take_news() reports the end.
    void plan(const Scene& scene, std::uint64_t seed, int frames);
    void film(const Registry& registry, const Setup& setup, const std::string& file, int width, int height);
    bool planning() const { return planning_.running(); }
    bool filming() const { return filming_.running(); }

    // The last audit's items. If stale(), they belong to an earlier version of the path.
    const std::vector<Row>& rows() const { return rows_; }
    bool stale() const { return audited_ != version_; }
    // Starts an audit in the background if the path has changed. Returns a message for the user about a finished plan
    // or film, or "".
    std::string take_news();
    // Returns the next frame after the position at which a promise is broken or a threshold missed, or else the first
    // such frame of the path; nullopt if there is none.
    std::optional<std::size_t> next_broken() const;
    // Requests an audit of all items, not only promises; this takes seconds.
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
