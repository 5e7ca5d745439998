// SPDX-License-Identifier: Apache-2.0
// The state of explore and its main loop.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/explore/path_editor.h"
#include "apps/explore/devices.h"
#include "apps/explore/export.h"
#include "apps/explore/input.h"
#include "apps/explore/motion.h"
#include "apps/explore/panes.h"
#include "apps/explore/settings.h"
#include "apps/explore/window.h"

namespace mandelmarch::explore {

class Script;

class Explorer {
public:
    Explorer(const Registry& registry, Window& window, const Settings& settings, std::string folder);
    ~Explorer();

    void run(Script* script);

    // Members that panels and commands use directly.
    const Registry& registry;
    Window& window;
    Settings settings;
    std::string folder;  // for saved files, whose names explore chooses; empty: the current folder
    Panes panes;
    Motion motion;
    PathEditor path_editor;
    PictureTask picture;
    Devices devices;
    std::deque<float> intervals;  // seconds between frames, of the last ten seconds
    Scene scene;                  // the view; its size is unused
    bool help = false;
    bool paths = false;
    bool quit = false;
    int picture_width = 1920, picture_height = 1080;
    int tour_seed = 1, tour_frames = 1800;

    // Shows a message to the user until the next message.
    void say(const std::string& text);
    const std::string& said() const { return said_; }

    // Calls `work`. If it throws an exception, catches it and shows its message to the user.
    template <class Work>
    void guarded(const Work& work)
    {
        try {
            work();
        } catch (const std::exception& error) {
            say(error.what());
        }
    }

    // Must be called after every change of the view, except by flying. The panes are then rendered again.
    void changed() { dirty_ = true; }
    void set_scene(const Scene& scene);
    void set_setup(const Setup& setup);
    // Saves the current state, so that undo() can restore it. Called before a change.
    void remember();
    void undo();
    void redo();

    // Sets the view to the current position in the path.
    void show_path();

    // Opens a parameter file or a path file. Errors are shown as messages.
    void open(const std::string& file);
    void save_view();
    void copy_view();
    void paste_view();
    void save_picture();
    void toggle_recording();
    void save_path();
    void film_path();
    void go_to_broken();
    void focus_panel();

    bool at_rest() const { return !moving_ && !panes.missing() && !panes.drawing(); }
    bool tasks_running() const { return picture.running() || path_editor.planning() || path_editor.filming(); }
    std::uint64_t frame() const { return frame_; }
    std::uint64_t view() const { return view_; }
    double clearance() const { return clearance_; }
    bool wants_panel_focus() { return std::exchange(focus_, false); }
    // Requests that a screenshot is written to `file` at the end of this frame.
    void shoot(const std::string& file) { shot_ = file; }
    std::string told() const;  // returns the state as one line of JSON

private:
    struct State {
        Scene scene;
        std::vector<Setup> setups;
    };

    void tick(Script* script);
    void take_events();
    void move(double seconds);
    double budget() const;
    void show();
    State state() const;
    void set_state(const State& state);
    void note_interval(double seconds);
    void wait_if_idle();

    Input input_;
    std::vector<State> past_, future_;
    std::string said_;
    std::string shot_;
    bool dirty_ = true;
    bool moving_ = false;
    bool focus_ = false;
    bool flew_ = false;
    std::uint64_t view_ = 0;
    std::uint64_t frame_ = 0;
    SDL_Rect area_{0, 0, 1, 1};  // part of the window for pictures
    double clearance_ = 0;
    double intervals_seconds_ = 0;
    double showing_ = 0.004;  // seconds per frame apart from rendering, averaged
    Moment last_{}, presented_{}, due_{};
};

}  // namespace mandelmarch::explore
