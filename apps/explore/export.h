// SPDX-License-Identifier: Apache-2.0
// Export: the view as a parameter file, and pictures of any size, identical to those that bin/render makes of that
// file.
#pragma once

#include <atomic>
#include <memory>
#include <stop_token>
#include <string>

#include "apps/explore/setup.h"
#include "apps/explore/task.h"
#include "core/render/registry.h"

namespace mandelmarch::explore {

// Resets everything that a parameter file does not contain, such as settings of films, except the kind of estimate.
void as_file(Scene& scene);

// Returns the content of the view's parameter file. A conservative estimate is recorded in a comment.
std::string view_text(const Scene& scene);

// Returns the bin/render command that makes the same picture.
std::string command_of(const Scene& scene, const Setup& setup, const std::string& file);

// Returns the first name FOLDER/STEM-NNN for which no .dat, .png, .json or .mp4 exists.
std::string free_name(const std::string& folder, const std::string& stem);

// Return the scene of a parameter file. Its fractal is guessed from the file's comments or name; `hint` if that fails.
// Throw InputError with a message that begins with the file's line.
Scene read_view(const std::string& file, const Fractal& hint);
Scene view_of_text(const std::string& text, const std::string& name, const Fractal& hint);

// Renders a picture file in its own thread.
class PictureTask {
public:
    // Writes NAME.dat, renders the scene as read from it, and writes NAME.png. Throws if it cannot start.
    void start(const Registry& registry, const Setup& setup, Scene scene, const std::string& name);
    bool running() const { return task_.running(); }
    double progress() const { return share_ != nullptr ? share_->load() : 0; }
    void cancel() { stop_.request_stop(); }
    // Returns a message about the end of the task, once; else "".
    std::string take_news();

private:
    Task<std::string> task_;
    std::shared_ptr<std::atomic<double>> share_;
    std::stop_source stop_;
};

}  // namespace mandelmarch::explore
