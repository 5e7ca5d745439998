// SPDX-License-Identifier: Apache-2.0
// The model: the state that explore shows and edits. It does not depend on the window and its panels.
#pragma once

#include <string>
#include <vector>

#include "apps/explore/model/files.h"
#include "apps/explore/model/motion.h"
#include "apps/explore/model/path_editor.h"
#include "apps/explore/model/shown_view.h"
#include "core/render/registry.h"

namespace mandelmarch::explore {

class Model {
public:
    // `folder`: the folder for saved files, whose names explore chooses; empty: the current folder. The registry must
    // outlive the process's threads.
    Model(const Registry& registry, const Settings& settings, std::string folder, const Scene& scene);

    const Registry& registry;
    const std::string folder;
    Settings settings;
    ShownView view;
    Motion motion;
    PathEditor path_editor;
    int film_width = 1920, film_height = 1080;  // pixels
    int tour_seed = 1, tour_frames = 1800;
    std::size_t next_start = 0;  // index in start_views() of the view that the action next-view shows
    bool marks = true;           // pixels that differ from the first pane are marked
    bool help = false;
    bool paths = false;  // the paths panel is shown
    bool quit = false;
    // Requests to the window, which resets them: full screen on or off; the keyboard to the panel or back.
    bool changes_full_screen = false, changes_focus = false;

    // Shows a message to the user until the next message.
    void say(const std::string& text) { said_ = text; }
    const std::string& said() const { return said_; }

    // Calls `work`. If it throws an exception, catches it and shows its message to the user.
    template <class Work>
    void attempt(const Work& work)
    {
        try {
            work();
        } catch (const std::exception& error) {
            say(error.what());
        }
    }

    // Shows a scene, and stops the camera and a playing path.
    void show(const Scene& scene);
    // Saves the current state for undo, then changes the view.
    void change(const Scene& scene);
    void change(const Setup& setup);
    // Returns the official scene of a fractal, in the look of the view.
    Scene official(const Fractal& fractal) const;
    // Shows the view in another look, a colouring type. The next run of explore starts with this look.
    void choose_look(int look);
    // Shows a view of start_views(). Errors are shown as messages.
    void start_from(const StartView& start);
    // Sets the view to the current position in the path.
    void show_path();
    // Opens a parameter file or a path file. Errors are shown as messages.
    void open(const std::string& file);

    bool tasks_running() const { return listing_.running() || path_editor.planning() || path_editor.filming(); }
    // Shows the messages of background work. Must be called regularly.
    void take_news();
    // Returns one listing of devices per backend, in the registry's order. A background task makes the listings,
    // because drivers can be slow; the result is empty until all are made.
    const std::vector<Listing>& listings();

private:
    std::string said_;
    Task<std::vector<Listing>> listing_;
    std::vector<Listing> listings_;
};

}  // namespace mandelmarch::explore
