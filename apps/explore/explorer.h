// SPDX-License-Identifier: Apache-2.0
// The program's state and its loop: events, camera, pictures, panels, frame after frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/explore/desk.h"
#include "apps/explore/devices.h"
#include "apps/explore/handout.h"
#include "apps/explore/hands.h"
#include "apps/explore/measure.h"
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

    // What panels and commands work with.
    const Registry& registry;
    Window& window;
    Settings settings;
    std::string folder;  // where files go that have no name of their own
    Panes panes;
    Motion motion;
    Desk desk;
    PictureTask picture;
    Devices devices;
    Measure measure;
    Scene scene;  // the view; its size means nothing
    bool help = false;
    bool paths = false;
    bool quit = false;
    int picture_width = 1920, picture_height = 1080;
    int tour_seed = 1, tour_frames = 1800;

    // A line for the user, until the next one.
    void say(const std::string& text);
    const std::string& said() const { return said_; }

    // Calls `work`; what it throws is said.
    template <class Work>
    void guarded(const Work& work)
    {
        try {
            work();
        } catch (const std::exception& error) {
            say(error.what());
        }
    }

    // The view has been changed, but by a flight.
    void changed() { dirty_ = true; }
    void set_scene(const Scene& scene);
    void set_setup(const Setup& setup);
    // What is there now can be come back to.
    void remember();
    void undo();
    void redo();

    // The path's picture where it is.
    void show_path();

    // A .dat or a path; what is wrong with it is said.
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
    bool tasks_running() const { return picture.running() || desk.planning() || desk.filming(); }
    std::uint64_t frame() const { return frame_; }
    std::uint64_t view() const { return view_; }
    double clearance() const { return clearance_; }
    bool wants_panel_focus() { return std::exchange(focus_, false); }
    // Where the script wants the window's picture to be written after this frame.
    void shoot(const std::string& file) { shot_ = file; }
    std::string told() const;  // the state as a line of JSON

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
    void wait_if_idle();

    Hands hands_;
    std::vector<State> past_, future_;
    std::string said_;
    std::string shot_;
    bool dirty_ = true;
    bool moving_ = false;
    bool focus_ = false;
    bool flew_ = false;
    std::uint64_t view_ = 0;
    std::uint64_t frame_ = 0;
    SDL_Rect area_{0, 0, 1, 1};  // of the pictures
    double clearance_ = 0;
    double showing_ = 0.004;  // seconds that a frame takes beside its picture
    Moment last_{}, presented_{}, due_{};
};

}  // namespace mandelmarch::explore
