// SPDX-License-Identifier: Apache-2.0
// The path editor: records, opens, plans, plays and smooths a path, and renders it as a film.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "apps/explore/model/files.h"
#include "core/render/registry.h"
#include "flight/path/path.h"

namespace mandelmarch::explore {

// A task in the background. It runs in a detached thread, which may be abandoned. The caller polls for the result.
template <class Result>
class Task {
public:
    // Starts `work` in a thread. `work` must own everything that it uses. Must not be called while a task is running.
    void start(std::function<Result()> work)
    {
        std::packaged_task<Result()> task(std::move(work));
        result_ = task.get_future();
        std::thread(std::move(task)).detach();
    }

    bool running() const { return result_.valid(); }

    // Returns the result at the first call after the task has ended. Returns nullopt if the task is still running or if
    // there is no task. If the task has failed, returns nullopt and sets `failure` to the error's message.
    std::optional<Result> take(std::string& failure)
    {
        if (!running() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
        try {
            return result_.get();
        } catch (const std::exception& error) {
            failure = error.what();
            return std::nullopt;
        }
    }

private:
    std::future<Result> result_;
};

class PathEditor {
public:
    bool recording() const { return recording_; }
    bool playing = false;

    bool has_path() const { return path_.frames.size() > 1; }
    const Path& path() const { return path_; }
    std::size_t frames() const { return path_.frames.size(); }
    double at() const { return at_; }  // the current position in the path, in frames
    void go_to(double frame);
    // Moves the position forwards. Stops playing at the end of the path.
    void advance(double seconds);
    // Returns the scene at the position, for a picture of this size in pixels.
    Scene scene(int width, int height) const;

    void open(const std::string& file) { take(read_path(file)); }  // throws InputError
    void save(const std::string& file) const;
    // Replaces the path.
    void take(Path path);

    void begin_recording(const Scene& scene);
    // Adds to the recording the camera's motion since the previous call. `seconds`: the time since the previous call.
    void record(const Scene& scene, double seconds);
    void end_recording();

    void smooth();
    // Starts to plan a tour of the scene's fractal in the background. film() starts to render the path as a film in the
    // background. take_news() reports the end of this work.
    void plan(const Scene& scene, std::uint64_t seed, int frames);
    void film(const Registry& registry, const Setup& setup, const std::string& file, int width, int height);
    bool planning() const { return planning_.running(); }
    bool filming() const { return filming_.running(); }
    double filmed() const { return *filmed_; }  // the finished share of the film in progress

    // Takes over the results of background work. Returns a message for the user if a plan or a film is finished or if
    // background work has failed; otherwise "". Must be called regularly.
    std::string take_news();

private:
    Path path_;
    double at_ = 0;
    bool recording_ = false;
    double owed_ = 0;  // time recorded since the last frame, in frames
    Task<Path> planning_;
    Task<std::string> filming_;
    std::shared_ptr<std::atomic<double>> filmed_;  // the film's thread, which writes it, can outlive this object
};

// Returns a frame whose camera lies between the cameras of `a` (share 0) and `b` (share 1). Its changes to the scene
// are those of the closer frame.
Frame between(const Frame& a, const Frame& b, double share);

// Returns a smoothed path. If smoothing would bring a camera too close to walls, the camera is moved less. Where a step
// or a turn would come close to the audit's limit, frames are added, which makes the flight slower.
Path smoothed(const Path& path);

}  // namespace mandelmarch::explore
