// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/explorer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "apps/explore/commands.h"
#include "apps/explore/panels.h"
#include "apps/explore/script.h"
#include "core/base/stopwatch.h"

namespace mandelmarch::explore {
namespace {

constexpr double spare = 0.0012;      // seconds of a frame kept free
constexpr double patience = 1.5;      // frames to wait for a picture while moving
constexpr double longest_step = 0.1;  // largest time step of the motion, seconds
constexpr double kept = 10;           // seconds of intervals between frames
constexpr int idle_wait = 100;        // milliseconds
constexpr double notch = 1.2;         // factor on the speed per notch of the wheel
constexpr double least_speed = 1.0 / 16, most_speed = 16;

Clock::duration duration(double seconds)
{
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

Explorer::Explorer(const Registry& registry_, Window& window_, const Settings& settings_, std::string folder_)
    : registry(registry_),
      window(window_),
      settings(settings_),
      folder(std::move(folder_)),
      panes(registry_, settings_.setup),
      devices(registry_)
{
    motion.speed = settings.speed;
    motion.collides = settings.collides;
    ImGui::GetIO().FontGlobalScale = static_cast<float>(settings.scale);
}

Explorer::~Explorer() = default;

void Explorer::run(Script* script)
{
    last_ = presented_ = due_ = Clock::now();
    while (!quit) tick(script);
    settings.speed = motion.speed;
    settings.collides = motion.collides;
    settings.setup = panes.all().front()->setup;
    std::tie(settings.width, settings.height) = window.size();
}

void Explorer::take_events()
{
    const ImGuiIO& io = ImGui::GetIO();
    const double height = std::max(1, panes.place(0).h);
    const double radians = scene.field_of_view * degrees_per_field * std::numbers::pi / 180 / height;
    for (SDL_Event event; SDL_PollEvent(&event) != 0;) {
        if (event.type == SDL_QUIT) quit = true;
        if (event.type == SDL_DROPFILE) {
            open(event.drop.file);
            SDL_free(event.drop.file);
        }
        Window::take(event);
        const bool command = take_command(*this, event);
        if (command) continue;
        if (event.type == SDL_MOUSEBUTTONDOWN && !io.WantCaptureMouse) {
            ImGui::SetWindowFocus(nullptr);
            for (std::size_t i = 0; i < panes.all().size(); ++i) {
                const SDL_Rect place = panes.place(i);
                const SDL_Point at{event.button.x, event.button.y};
                if (SDL_PointInRect(&at, &place) != 0) panes.choose(i);
            }
        }
        input_.take(event, io.WantCaptureMouse, io.WantCaptureKeyboard || io.WantTextInput, radians);
    }
}

void Explorer::move(double seconds)
{
    const MotionInput wish = input_.wish();
    if (const double notches = input_.take_notches(); notches != 0) {
        motion.speed = std::clamp(motion.speed * std::pow(notch, notches), least_speed, most_speed);
    }
    const bool flies = wish.any();
    if (flies && !flew_) remember();
    const bool played = path_editor.playing && path_editor.has_path() && !flies;
    if (flies) path_editor.playing = false;
    flew_ = flies;
    if (played) {
        path_editor.advance(seconds);
        motion.stop();
        const SDL_Rect place = panes.place(0);
        scene = path_editor.scene(place.w, place.h);
    }
    moving_ = false;
    guarded([&] { moving_ = motion.move(scene, wish, seconds); });
    // The view may come from a path. As soon as the user flies, settings for films and others that a parameter file
    // cannot contain are reset.
    if (moving_) {
        as_file(scene);
    }
    if (moving_ && path_editor.recording()) path_editor.record(scene, seconds);
    moving_ = moving_ || played;
    const SDL_Rect area = area_beside_panels(*this);
    const bool resized = SDL_RectEquals(&area, &area_) == SDL_FALSE;
    area_ = area;
    if (!moving_ && !dirty_ && !resized) return;
    ++view_;
    dirty_ = false;
    guarded([&] { clearance_ = motion.clearance(scene); });
    panes.look(scene, view_, area_);
}

// Returns the time for rendering in seconds while the camera moves. It is the part of a screen frame that other work
// leaves. If pictures would then have less than 3/8 of the full width, a second screen frame is added.
double Explorer::budget() const
{
    const double period = 1 / window.rate();
    const double one = period - showing_ - spare;
    const SDL_Rect place = panes.place(0);
    const double count = static_cast<double>(panes.all().size());
    const auto small = panes.all().front()->resolution.size(place.w, place.h, one / count).first < place.w * 3 / 8;
    return std::max(one + (small ? period : 0), 0.002);
}

void Explorer::tick(Script* script)
{
    ++frame_;
    const Moment begin = Clock::now();
    const double period = 1 / window.rate();
    const double seconds = std::clamp(std::chrono::duration<double>(begin - last_).count(), 1e-4, longest_step);
    last_ = begin;
    if (script != nullptr) guarded([&] { script->step(*this); });
    take_events();
    move(seconds);
    if (const std::string news = path_editor.take_news(); !news.empty()) say(news);
    if (const std::string news = picture.take_news(); !news.empty()) say(news);

    const double given = budget();
    panes.work(window.renderer(), moving_, given, begin);
    const Moment build = Clock::now();
    window.begin();
    show_panels(*this);
    // At the start no panel has the keyboard, so that keys move the camera.
    if (frame_ <= 2) ImGui::SetWindowFocus(nullptr);
    const double building = seconds_since(build);
    const double wait = moving_ ? std::max(given + building, patience * period - showing_) : period - showing_ - spare;
    panes.work(window.renderer(), moving_, given, begin + duration(wait));
    const Moment drawn = Clock::now();
    show();
    const Moment end = Clock::now();
    const double showing = building + std::chrono::duration<double>(end - drawn).count();
    showing_ += 0.1 * (showing - showing_);
    note_interval(std::chrono::duration<double>(end - presented_).count());
    presented_ = end;
    if (window.waits()) return wait_if_idle();
    // Here present() does not wait for the screen, so a timer limits the frame rate to the screen's.
    due_ = std::max(due_ + duration(period), end);
    std::this_thread::sleep_until(due_);
    wait_if_idle();
}

void Explorer::note_interval(double seconds)
{
    intervals.push_back(static_cast<float>(seconds));
    intervals_seconds_ += seconds;
    while (intervals.size() > 1 && intervals_seconds_ > kept) {
        intervals_seconds_ -= static_cast<double>(intervals.front());
        intervals.pop_front();
    }
}

void Explorer::wait_if_idle()
{
    if (moving_ || tasks_running() || path_editor.planning() || !at_rest()) return;
    SDL_WaitEventTimeout(nullptr, idle_wait);
    last_ = presented_ = due_ = Clock::now();
}

void Explorer::show()
{
    for (std::size_t i = 0; i < panes.all().size(); ++i) {
        const SDL_Rect place = panes.place(i);
        panes.all()[i]->sheet.show(window.renderer(), place);
    }
    window.draw_panels();
    if (!shot_.empty()) guarded([&] { window.shoot(std::exchange(shot_, {})); });
    window.present();
}

void Explorer::say(const std::string& text) { said_ = text; }

Explorer::State Explorer::state() const
{
    State state{scene, {}};
    for (const auto& pane : panes.all()) state.setups.push_back(pane->setup);
    return state;
}

void Explorer::set_state(const State& state)
{
    scene = state.scene;
    panes.set_count(state.setups.size());
    for (std::size_t i = 0; i < state.setups.size(); ++i) panes.set(*panes.all()[i], state.setups[i]);
    motion.stop();
    changed();
}

void Explorer::remember()
{
    constexpr std::size_t most = 500;
    past_.push_back(state());
    if (past_.size() > most) past_.erase(past_.begin());
    future_.clear();
}

void Explorer::undo()
{
    if (past_.empty()) return say("there is nothing to undo");
    future_.push_back(state());
    set_state(past_.back());
    past_.pop_back();
}

void Explorer::redo()
{
    if (future_.empty()) return say("there is nothing to redo");
    past_.push_back(state());
    set_state(future_.back());
    future_.pop_back();
}

void Explorer::set_scene(const Scene& wanted)
{
    scene = wanted;
    path_editor.playing = false;
    motion.stop();
    changed();
}

void Explorer::set_setup(const Setup& setup)
{
    panes.set(panes.chosen(), setup);
    changed();
}

void Explorer::focus_panel()
{
    input_.let_go();
    focus_ = true;
    settings.panel = true;
}

}  // namespace mandelmarch::explore
