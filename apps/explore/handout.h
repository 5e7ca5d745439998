// SPDX-License-Identifier: Apache-2.0
// What is handed out: the view as a parameter file, and pictures of any size, as bin/render draws them of that file.
#pragma once

#include <atomic>
#include <memory>
#include <stop_token>
#include <string>

#include "apps/explore/setup.h"
#include "apps/explore/task.h"
#include "core/render/registry.h"

namespace mandelmarch::explore {

// Leaves a scene what a parameter file has, and its estimate: nothing that films ask for beside.
void as_file(Scene& scene);

// The text of the view's parameter file. A conservative estimate is said in a comment.
std::string view_text(const Scene& scene);

// The command by which bin/render draws the same.
std::string command_of(const Scene& scene, const Setup& setup, const std::string& file);

// The first name FOLDER/STEM-NNN that has no file with any of the usual endings yet.
std::string free_name(const std::string& folder, const std::string& stem);

// The scene of a parameter file, of the fractal that it, or its name, seems to be about; `hint` where nothing tells.
// Throws InputError, which begins with the file's line.
Scene read_view(const std::string& file, const Fractal& hint);
Scene view_of_text(const std::string& text, const std::string& name, const Fractal& hint);

// A picture in the making, in a thread of its own.
class PictureTask {
public:
    // Writes NAME.dat, draws the scene that this reads as, and writes NAME.png. Throws where it cannot begin.
    void start(const Registry& registry, const Setup& setup, Scene scene, const std::string& name);
    bool running() const { return task_.running(); }
    double progress() const { return share_ != nullptr ? share_->load() : 0; }
    void cancel() { stop_.request_stop(); }
    // What became of it, for the user, once; else "".
    std::string take_news();

private:
    Task<std::string> task_;
    std::shared_ptr<std::atomic<double>> share_;
    std::stop_source stop_;
};

}  // namespace mandelmarch::explore
