// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/explore/explorer.h"
#include "apps/explore/panels.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/image/image.h"

namespace mandelmarch::explore {
namespace {

constexpr float width_in_letters = 44;   // width of the panel
constexpr float most_of_window = 0.55F;  // largest fraction of the window's width for the panel
constexpr float graph_height = 48;       // pixels

// Must be called after each item that edits the scene. When the user begins to use the item, saves the scene as it was
// before, for undo(). `is_new`: the item has changed the scene.
void follow(Explorer& explorer, bool is_new, const Scene& before)
{
    if (ImGui::IsItemActivated()) {
        const Scene now = std::exchange(explorer.scene, before);
        explorer.remember();
        explorer.scene = now;
    }
    if (is_new) explorer.changed();
}

void number(Explorer& explorer, const std::string& name, double& value, const ParameterInfo& meaning, double official)
{
    if (meaning.name == ignored_number.name) return;
    const Scene before = explorer.scene;
    // If the descriptor does not set a range, the slider covers values around the official one, as in fractals_json().
    const double around = std::max(1.0, 0.5 * std::abs(official));
    const double low = meaning.slider ? meaning.slider->low : std::max(meaning.low, official - around);
    const double high = meaning.slider ? meaning.slider->high : std::min(meaning.high, official + around);
    double wanted = value;
    const bool is_new = ImGui::SliderScalar(name.c_str(), ImGuiDataType_Double, &wanted, &low, &high, "%.6g");
    const bool allowed = meaning.open_low ? wanted > meaning.low : wanted >= meaning.low;
    // The value is rounded to single precision, as in parameter files.
    if (is_new && allowed && wanted <= meaning.high) value = static_cast<float>(wanted);
    follow(explorer, is_new, before);
}

void whole(Explorer& explorer, const char* name, int& value, int low, int high, int usual)
{
    const Scene before = explorer.scene;
    const bool is_new = ImGui::SliderInt(name, &value, low, usual);
    value = std::clamp(value, low, high);
    follow(explorer, is_new, before);
}

void vector(Explorer& explorer, const char* name, Vector& value)
{
    const Scene before = explorer.scene;
    // Rounding errors such as 4.4e-16 are shown as 0, because the field is too narrow for an exponent.
    const auto shown = [](double c) { return std::abs(c) < 1e-12 ? 0 : c; };
    double numbers[3] = {shown(value.x), shown(value.y), shown(value.z)};
    const bool is_new = ImGui::InputScalarN(name, ImGuiDataType_Double, numbers, 3, nullptr, nullptr, "%.9g");
    if (is_new) value = {numbers[0], numbers[1], numbers[2]};
    try {
        check_scene(explorer.scene, [](Item) { return std::string("the view"); });
    } catch (const std::exception& error) {
        explorer.say(error.what());
        explorer.scene = before;
    }
    follow(explorer, is_new, before);
}

void view(Explorer& explorer)
{
    Scene& scene = explorer.scene;
    const Scene official = official_scene(*scene.fractal);
    if (ImGui::BeginCombo("fractal", std::string(scene.fractal->name).c_str())) {
        for (const Fractal& fractal : fractals()) {
            if (!ImGui::Selectable(std::string(fractal.name).c_str(), &fractal == scene.fractal)) continue;
            explorer.remember();
            explorer.set_scene(official_scene(fractal));
        }
        ImGui::EndCombo();
    }
    const Fractal& fractal = *scene.fractal;
    for (std::size_t i = 0; i < 3; ++i) {
        number(explorer, std::string(fractal.shape.at(i).name), scene.shape.at(i), fractal.shape.at(i),
               official.shape.at(i));
    }
    number(explorer, std::string(fractal.escape.name), scene.escape, fractal.escape, official.escape);
    whole(explorer, "iterations", scene.iterations, 1, max_iterations, 200);
    number(explorer, "detail level", scene.detail, {"", -37, 3, false, ParameterInfo::Slider{-6, -1, 0.1}}, -3);
    number(explorer, "field of view", scene.field_of_view,
           {"", 1e-3, 2.7, false, ParameterInfo::Slider{0.2, 2.5, 0.05}}, 1);
    whole(explorer, "colouring type", scene.colouring, 0, colouring_types - 1, colouring_types - 1);
    number(explorer, "brightness", scene.brightness, {"", 0, 1e6, false, ParameterInfo::Slider{0.2, 3, 0.1}}, 1);
    const Scene before = scene;
    follow(explorer, ImGui::Checkbox("conservative estimate", &scene.conservative), before);
    vector(explorer, "eye", scene.eye);
    vector(explorer, "look at", scene.target);
    vector(explorer, "up", scene.up);
    const double slow = -4;
    const double fast = 4;
    double power = std::log2(explorer.motion.speed);
    if (ImGui::SliderScalar("speed", ImGuiDataType_Double, &power, &slow, &fast, "2^%.2f DE/s")) {
        explorer.motion.speed = std::exp2(power);
    }
    ImGui::Checkbox("walls stop the flight", &explorer.motion.collides);
    if (ImGui::Button("reset view")) {
        explorer.remember();
        explorer.set_scene(official);
    }
    ImGui::SameLine();
    if (ImGui::Button("undo")) explorer.undo();
    ImGui::SameLine();
    if (ImGui::Button("redo")) explorer.redo();
}

void choose_setup(Explorer& explorer, const Setup& setup)
{
    explorer.remember();
    explorer.set_setup(setup);
}

void drawn_by(Explorer& explorer)
{
    Panes& panes = explorer.panes;
    int count = static_cast<int>(panes.all().size());
    if (ImGui::SliderInt("side by side", &count, 1, most_panes)) {
        explorer.remember();
        panes.set_count(static_cast<std::size_t>(std::clamp(count, 1, most_panes)));
        explorer.changed();
    }
    if (panes.all().size() > 1) {
        int chosen = static_cast<int>(panes.chosen_number()) + 1;
        if (ImGui::SliderInt("pane", &chosen, 1, count))
            panes.choose(static_cast<std::size_t>(std::max(1, chosen)) - 1);
        if (ImGui::Checkbox("mark differing pixels", &panes.marks)) explorer.changed();
    }
    const Setup now = panes.chosen().setup;
    const auto& listings = explorer.devices.listings();
    if (ImGui::BeginCombo("backend", fmt::format("{}:{}", now.backend, now.device).c_str(),
                          ImGuiComboFlags_HeightLarge)) {
        std::size_t at = 0;
        for (const auto& backend : explorer.registry.backends()) {
            const Listing listing = at < listings.size() ? listings[at] : Listing{{{"", "", "", false}}, "", ""};
            ++at;
            for (std::size_t i = 0; i < listing.devices.size(); ++i) {
                const std::string name = fmt::format("{}:{} {}", backend->name(), i, listing.devices[i].name);
                const bool is = now.backend == backend->name() && now.device == static_cast<int>(i);
                if (!ImGui::Selectable(name.c_str(), is)) continue;
                Setup setup = now;
                setup.backend = backend->name();
                setup.device = static_cast<int>(i);
                if (backend->info().role == Role::reference) setup.precision = Precision::f64;
                choose_setup(explorer, setup);
            }
            const std::string& why = listing.failure.empty() ? listing.unavailable : listing.failure;
            if (!why.empty()) ImGui::TextDisabled("%s: %s", std::string(backend->name()).c_str(), why.c_str());
        }
        ImGui::EndCombo();
    }
    const auto two = [&](const char* first, const char* second, bool is_first, const auto& flip) {
        Setup setup = now;
        if (ImGui::RadioButton(first, is_first) && !is_first) choose_setup(explorer, flip(setup));
        ImGui::SameLine();
        if (ImGui::RadioButton(second, !is_first) && is_first) choose_setup(explorer, flip(setup));
    };
    two("float", "double", now.precision == Precision::f32, [](Setup& setup) {
        setup.precision = setup.precision == Precision::f32 ? Precision::f64 : Precision::f32;
        return setup;
    });
    two("fast", "exact", now.mode == Mode::fast, [](Setup& setup) {
        setup.mode = setup.mode == Mode::fast ? Mode::exact : Mode::fast;
        return setup;
    });
}

void hand_out(Explorer& explorer)
{
    if (ImGui::Button("save view")) explorer.save_view();
    ImGui::SameLine();
    if (ImGui::Button("copy")) explorer.copy_view();
    ImGui::SameLine();
    if (ImGui::Button("paste")) explorer.paste_view();
    int size[2] = {explorer.picture_width, explorer.picture_height};
    if (ImGui::InputInt2("picture", size)) {
        explorer.picture_width = std::clamp(size[0], 1, max_side);
        explorer.picture_height = std::clamp(size[1], 1, max_side);
    }
    if (!explorer.picture.running()) {
        if (ImGui::Button("save picture")) explorer.save_picture();
        return;
    }
    ImGui::ProgressBar(static_cast<float>(explorer.picture.progress()));
    if (ImGui::Button("cancel picture")) explorer.picture.cancel();
}

void graph(const Explorer& explorer)
{
    const auto& last = explorer.intervals;
    if (last.empty()) return;
    double total = 0;
    for (const float seconds : last) total += static_cast<double>(seconds);
    ImGui::PlotLines(
        "##frames",
        [](void* data, int at) {
            return 1000 * (*static_cast<const std::deque<float>*>(data))[static_cast<std::size_t>(at)];
        },
        const_cast<std::deque<float>*>(&last), static_cast<int>(last.size()), 0,
        fmt::format("{:.0f} frames per second over the last ten seconds; top 50 ms",
                    static_cast<double>(last.size()) / total)
            .c_str(),
        0, 50, ImVec2(-1, graph_height));
}

}  // namespace

float panel_width(const Explorer& explorer)
{
    if (!explorer.settings.panel) return 0;
    // The width follows from the font's nominal size, because the size that ImGui returns is 0 before the first frame.
    const float letter = 13 * ImGui::GetIO().FontGlobalScale;
    const auto [width, height] = explorer.window.size();
    return std::round(std::min(width_in_letters * letter * 0.6F, most_of_window * static_cast<float>(width)));
}

SDL_Rect area_beside_panels(const Explorer& explorer)
{
    const auto [width, height] = explorer.window.size();
    const int left = static_cast<int>(panel_width(explorer));
    return {left, 0, std::max(1, width - left), height};
}

void show_panel(Explorer& explorer)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({panel_width(explorer), size.y});
    if (explorer.wants_panel_focus()) ImGui::SetNextWindowFocus();
    ImGui::Begin("panel", nullptr,
                 (ImGuiWindowFlags_NoDecoration & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushItemWidth(ImGui::GetWindowWidth() * 0.55F);
    ImGui::TextDisabled("F1 help, F2 hides this, Esc in and out");
    if (ImGui::CollapsingHeader("backend and mode", ImGuiTreeNodeFlags_DefaultOpen)) drawn_by(explorer);
    if (ImGui::CollapsingHeader("view", ImGuiTreeNodeFlags_DefaultOpen)) view(explorer);
    if (ImGui::CollapsingHeader("save and export", ImGuiTreeNodeFlags_DefaultOpen)) hand_out(explorer);
    if (ImGui::Checkbox("paths", &explorer.paths)) {
    }
    ImGui::SameLine();
    ImGui::Checkbox("statistics", &explorer.settings.statistics);
    float scale = static_cast<float>(explorer.settings.scale);
    if (ImGui::SliderFloat("text size", &scale, 0.5F, 4.0F, "%.1f")) {
        explorer.settings.scale = static_cast<double>(scale);
        ImGui::GetIO().FontGlobalScale = scale;
    }
    graph(explorer);
    ImGui::PopItemWidth();
    ImGui::End();
}

}  // namespace mandelmarch::explore
