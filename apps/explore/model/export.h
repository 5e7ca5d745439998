// SPDX-License-Identifier: Apache-2.0
// Export: writes the view as a parameter file, and pictures of any size. The pictures are identical to those that
// bin/render makes from that file.
#pragma once

#include <atomic>
#include <memory>
#include <stop_token>
#include <string>

#include "apps/explore/model/setup.h"
#include "apps/explore/model/task.h"
#include "core/render/registry.h"

namespace mandelmarch::explore {

// Resets the properties of a scene that a parameter file does not contain, such as those of films. The kind of estimate
// is kept.
void as_file(Scene& scene);

// Returns the text of the view's parameter file. If the estimate is conservative, a comment records it.
std::string view_text(const Scene& scene);

// Returns the command of bin/render that makes the same picture. `file`: the scene's parameter file.
std::string command_of(const Scene& scene, const Setup& setup, const std::string& file);

// Returns the first of FOLDER/STEM-001, FOLDER/STEM-002, ... for which no file with the extension .dat, .png, .json or
// .mp4 exists.
std::string free_name(const std::string& folder, const std::string& stem);

// Appends the view to a places file (flight/path/places.h), which is created if it does not exist. Returns how many
// places the file then has. Throws InputError if the file is not a places file.
std::size_t append_place(const std::string& file, const Scene& scene);

// Returns the scene of a parameter file. The fractal is found by its name in the file's text or in the file's name. If
// neither contains a fractal's name, the fractal is `hint`. Throws InputError with a message that begins with the
// file's name and line.
Scene read_view(const std::string& file, const Fractal& hint);
Scene view_of_text(const std::string& text, const std::string& name, const Fractal& hint);

// Renders a picture to a file in a background thread.
class PictureTask {
public:
    // Writes NAME.dat, then renders the scene of this file in the background and writes NAME.png. Throws if a picture
    // is being rendered already, the backend does not exist, memory is insufficient or a file cannot be written.
    void start(const Registry& registry, const Setup& setup, Scene scene, const std::string& name);
    bool running() const { return task_.running(); }
    double progress() const { return share_ != nullptr ? share_->load() : 0; }
    void cancel() { stop_.request_stop(); }
    // Returns a message at the first call after the task has ended; otherwise "".
    std::string take_news() { return news_of(task_, "picture"); }

private:
    Task<std::string> task_;
    std::shared_ptr<std::atomic<double>> share_;
    std::stop_source stop_;
};

}  // namespace mandelmarch::explore
