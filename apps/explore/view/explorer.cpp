// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/view/explorer.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>
#include <tuple>
#include <utility>

#include "apps/explore/view/panels.h"
#include "core/os/stopwatch.h"
#include "core/scene/fractal.h"

namespace mandelmarch::explore {
namespace {

constexpr double spare = 0.0012;      // seconds of a frame that are kept free
constexpr double patience = 1.5;      // frames to wait for a picture while the camera moves
constexpr double longest_step = 0.1;  // largest time step of the motion, seconds
constexpr int idle_wait = 100;        // milliseconds; longest wait for an event while nothing changes
constexpr double notch = 1.2;         // factor on the speed per notch of the wheel
constexpr double least_speed = 1.0 / 16, most_speed = 16;

Clock::duration duration(double seconds)
{
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

Explorer::Explorer(Model& model, Window& window)
    : model_(model), window_(window), panes_(model.registry, model.view.setup())
{
    ImGui::GetIO().FontGlobalScale = static_cast<float>(model.settings.scale);
    arrange();
}

void Explorer::run(const std::function<void()>& before_frame)
{
    last_ = due_ = Clock::now();
    while (!model_.quit) {
        model_.attempt(before_frame);
        tick();
    }
    Settings& settings = model_.settings;
    settings.speed = model_.motion.speed;
    settings.collides = model_.motion.collides;
    settings.setup = model_.view.setups().front();
    std::tie(settings.width, settings.height) = window_.size();
}

// Performs the action of a key. Returns false if the event is not the key of an action, or if a panel uses the key.
bool Explorer::take_key(const SDL_Event& event)
{
    if (event.type != SDL_KEYDOWN) return false;
    const bool control = (event.key.keysym.mod & KMOD_CTRL) != 0;
    const std::string key = (control ? "Ctrl+" : "") + std::string(SDL_GetKeyName(event.key.keysym.sym));
    const auto found = std::ranges::find(actions(), key, &Action::key);
    if (key.empty() || found == actions().end()) return false;
    const ImGuiIO& io = ImGui::GetIO();
    if (found->heeded != Action::Heeded::anywhere && (io.WantCaptureKeyboard || io.WantTextInput)) return false;
    if (event.key.repeat == 0 || found->heeded == Action::Heeded::repeated) found->perform(model_);
    return true;
}

void Explorer::take_events()
{
    const ImGuiIO& io = ImGui::GetIO();
    const Scene scene = model_.view.shown();
    const double radians = scene.field_of_view * degrees_per_field * std::numbers::pi / 180 / scene.height;
    for (SDL_Event event; SDL_PollEvent(&event) != 0;) {
        if (event.type == SDL_QUIT) model_.quit = true;
        if (event.type == SDL_DROPFILE) {
            model_.open(event.drop.file);
            SDL_free(event.drop.file);
        }
        Window::take(event);
        if (take_key(event)) continue;
        if (event.type == SDL_MOUSEBUTTONDOWN && !io.WantCaptureMouse) {
            ImGui::SetWindowFocus(nullptr);
            for (std::size_t i = 0; i < panes_.all().size(); ++i) {
                const SDL_Rect place = panes_.place(i);
                const SDL_Point at{event.button.x, event.button.y};
                if (SDL_PointInRect(&at, &place) != 0) model_.view.choose(i);
            }
        }
        input_.take(event, io.WantCaptureMouse, io.WantCaptureKeyboard || io.WantTextInput, radians);
    }
    if (std::exchange(model_.changes_full_screen, false)) window_.toggle_full_screen();
    if (!std::exchange(model_.changes_focus, false)) return;
    focus_ = !io.NavActive || !io.WantCaptureKeyboard;
    if (focus_) {
        model_.settings.panel = true;
        input_.let_go();
    } else {
        ImGui::SetWindowFocus(nullptr);
    }
}

void Explorer::move(double seconds)
{
    Motion& motion = model_.motion;
    PathEditor& path_editor = model_.path_editor;
    const MotionInput wish = input_.wish();
    if (const double notches = input_.take_notches(); notches != 0) {
        motion.speed = std::clamp(motion.speed * std::pow(notch, notches), least_speed, most_speed);
    }
    const bool flies = wish.any();
    if (flies && !flew_) model_.view.remember();
    flew_ = flies;
    if (flies) path_editor.playing = false;
    const bool plays = path_editor.playing && path_editor.has_path();
    Scene scene = model_.view.scene();
    if (plays) {
        path_editor.advance(seconds);
        motion.stop();
        scene = path_editor.scene(scene.width, scene.height);
    }
    moving_ = false;
    model_.attempt([&] { moving_ = motion.move(scene, wish, seconds); });
    // The view may come from a path. As soon as the user flies, the properties that a parameter file cannot contain,
    // such as those of films, are reset.
    if (moving_) {
        as_file(scene);
        if (path_editor.recording()) path_editor.record(scene, seconds);
    }
    moving_ = moving_ || plays;
    if (moving_) model_.view.set(scene);
}

// Gives the pictures the part of the window beside the panel.
void Explorer::arrange()
{
    const auto [width, height] = window_.size();
    panel_width_ = model_.settings.panel ? panel_width(width) : 0;
    const int left = static_cast<int>(panel_width_);
    area_ = {left, 0, std::max(1, width - left), height};
    panes_.arrange(model_.view.setups(), area_);
    model_.view.set_size(panes_.place(0).w, panes_.place(0).h, static_cast<double>(area_.w) / area_.h);
}

// Returns the time in seconds for rendering while the camera moves. It is the part of a screen frame's time that other
// work leaves. If pictures rendered in this time would have less than 3/8 of a pane's width, the time of a second
// screen frame is added.
double Explorer::budget() const
{
    const double period = 1 / window_.rate();
    const double one = period - showing_ - spare;
    const SDL_Rect place = panes_.place(0);
    const double count = static_cast<double>(panes_.all().size());
    const auto small = panes_.all().front().resolution.size(place.w, place.h, one / count).first < place.w * 3 / 8;
    return std::max(one + (small ? period : 0), 0.002);
}

void Explorer::tick()
{
    ++frame_;
    const Moment begin = Clock::now();
    const double period = 1 / window_.rate();
    const double seconds = std::clamp(std::chrono::duration<double>(begin - last_).count(), 1e-4, longest_step);
    last_ = begin;
    take_events();
    move(seconds);
    arrange();
    const ShownView& view = model_.view;
    if (seen_ != view.version()) {
        seen_ = view.version();
        model_.attempt([&] { clearance_ = model_.motion.clearance(view.scene()); });
    }
    panes_.set_view(view.shown(), view.version(), model_.marks);
    model_.take_news();

    const double given = budget();
    panes_.work(window_.renderer(), moving_, given, begin);
    const Moment build = Clock::now();
    window_.begin();
    show_panels();
    const double building = seconds_since(build);
    const double wait = moving_ ? std::max(given + building, patience * period - showing_) : period - showing_ - spare;
    panes_.work(window_.renderer(), moving_, given, begin + duration(wait));
    const Moment drawn = Clock::now();
    show();
    const Moment end = Clock::now();
    const double showing = building + std::chrono::duration<double>(end - drawn).count();
    showing_ += 0.1 * (showing - showing_);
    if (window_.waits()) return wait_if_idle();
    // Here present() does not wait for the screen, so a timer limits the frame rate to the screen's.
    due_ = std::max(due_ + duration(period), end);
    std::this_thread::sleep_until(due_);
    wait_if_idle();
}

void Explorer::wait_if_idle()
{
    if (model_.tasks_running() || !at_rest()) return;
    SDL_WaitEventTimeout(nullptr, idle_wait);
    last_ = due_ = Clock::now();
}

void Explorer::show_panels()
{
    show_overlay(model_, panes_, area_, clearance_);
    if (model_.settings.panel) show_panel(model_, panel_width_, std::exchange(focus_, false));
    if (model_.paths) show_paths(model_, panel_width_);
    if (model_.help) show_help(model_);
    // At the start no panel has the keyboard, so that keys move the camera.
    if (frame_ <= 2) ImGui::SetWindowFocus(nullptr);
}

void Explorer::show()
{
    for (std::size_t i = 0; i < panes_.all().size(); ++i) {
        const SDL_Rect place = panes_.place(i);
        SDL_Texture* texture = panes_.all()[i].texture.get();
        if (texture != nullptr) SDL_RenderCopy(window_.renderer(), texture, nullptr, &place);
    }
    window_.draw_panels();
    window_.present();
}

std::string Explorer::state() const
{
    using Json = nlohmann::ordered_json;
    Json drawn = Json::array();
    for (const Pane& pane : panes_.all()) {
        drawn.push_back({{"setup", name_of(pane.setup)},
                         {"samples", pane.samples},
                         {"failure", pane.failure},
                         {"differing", pane.compared ? Json(pane.compared->differing) : Json()}});
    }
    const PathEditor& path_editor = model_.path_editor;
    const Scene& scene = model_.view.scene();
    const Json json{{"fractal", scene.fractal->name},
                    {"colouring", scene.colouring},
                    {"eye", {scene.eye.x, scene.eye.y, scene.eye.z}},
                    {"panes", drawn},
                    {"said", model_.said()},
                    {"path", {{"frames", path_editor.frames()}, {"at", path_editor.at()}}}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mandelmarch::explore
