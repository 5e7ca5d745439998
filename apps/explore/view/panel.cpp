// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>

#include "apps/explore/view/panels.h"
#include "apps/scene_json.h"
#include "core/image/image.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch::explore {
namespace {

constexpr float width_in_letters = 44;   // width of the panel
constexpr float most_of_window = 0.55F;  // largest fraction of the window's width for the panel

// The items that edit the scene. Each shows a property of `scene`, which is a copy of the view's scene.
class SceneItems {
public:
    explicit SceneItems(Model& model) : scene(model.view.scene()), model_(model) {}

    Scene scene;

    void number(std::string_view name, double& value, const ParameterInfo& meaning, double official)
    {
        if (meaning.name == ignored_number.name) return;
        const auto [low, high, step] = slider_of(meaning, official);
        double wanted = value;
        const bool is_new =
            ImGui::SliderScalar(std::string(name).c_str(), ImGuiDataType_Double, &wanted, &low, &high, "%.6g");
        const bool allowed = meaning.open_low ? wanted > meaning.low : wanted >= meaning.low;
        // The value is rounded to single precision, as in parameter files.
        if (is_new && allowed && wanted <= meaning.high) value = static_cast<float>(wanted);
        follow(is_new);
    }

    // Shows a slider up to `usual`. Values up to `high` can be typed.
    void integer(const char* name, int& value, int low, int high, int usual)
    {
        const bool is_new = ImGui::SliderInt(name, &value, low, usual);
        value = std::clamp(value, low, high);
        follow(is_new);
    }

    void vector(const char* name, Vector& value)
    {
        // Rounding errors such as 4.4e-16 are shown as 0, because the field is too narrow for an exponent.
        const auto shown = [](double c) { return std::abs(c) < 1e-12 ? 0 : c; };
        double numbers[3] = {shown(value.x), shown(value.y), shown(value.z)};
        const bool is_new = ImGui::InputScalarN(name, ImGuiDataType_Double, numbers, 3, nullptr, nullptr, "%.9g");
        if (is_new) value = {numbers[0], numbers[1], numbers[2]};
        follow(is_new);
    }

    void box(const char* name, bool& value) { follow(ImGui::Checkbox(name, &value)); }

private:
    // Must be called after each item. When the user begins to use the item, saves the view for undo. `is_new`: the item
    // has changed the scene.
    void follow(bool is_new)
    {
        if (ImGui::IsItemActivated()) model_.view.remember();
        if (!is_new) return;
        model_.attempt([&] {
            check_scene(scene, [](Item) { return std::string("the view"); });
            model_.view.set(scene);
        });
        scene = model_.view.scene();
    }

    Model& model_;
};

// Shows a list of names. If the user chooses an item, calls `choose` with it. `shown`: the name of the current item.
template <class Items, class Name, class Choose>
void list(const char* label, std::string_view shown, const Items& items, const Name& name, const Choose& choose)
{
    if (!ImGui::BeginCombo(label, std::string(shown).c_str())) return;
    for (const auto& item : items) {
        const std::string_view text = std::invoke(name, item);
        if (ImGui::Selectable(std::string(text).c_str(), text == shown)) choose(item);
    }
    ImGui::EndCombo();
}

void lists(Model& model)
{
    const Scene& scene = model.view.scene();
    list("fractal", scene.fractal->name, fractals(), &Fractal::name,
         [&](const Fractal& fractal) { model.change(model.official(fractal)); });
    list("start from", "choose a view", start_views(), &StartView::name,
         [&](const StartView& start) { model.start_from(start); });
    list("look", colouring_names.at(static_cast<std::size_t>(scene.colouring)), colouring_names, std::identity(),
         [&](const std::string_view& name) { model.choose_look(static_cast<int>(&name - colouring_names.data())); });
}

void scene_items(Model& model)
{
    lists(model);
    SceneItems items(model);
    Scene& scene = items.scene;
    const Fractal& fractal = *scene.fractal;
    const Scene official = official_scene(fractal);
    for (std::size_t i = 0; i < fractal.shape.size(); ++i) {
        items.number(fractal.shape.at(i).name, scene.shape.at(i), fractal.shape.at(i), official.shape.at(i));
    }
    items.number(fractal.escape.name, scene.escape, fractal.escape, official.escape);
    items.integer("iterations", scene.iterations, 1, max_iterations, 200);
    items.number("detail level", scene.detail, {"", -37, 3, false, ParameterInfo::Slider{-6, -1, 0.1}}, -3);
    items.number("field of view", scene.field_of_view, {"", 1e-3, 2.7, false, ParameterInfo::Slider{0.2, 2.5, 0.05}},
                 1);
    items.number("brightness", scene.brightness, {"", 0, 1e6, false, ParameterInfo::Slider{0.2, 3, 0.1}}, 1);
    items.box("conservative estimate", scene.conservative);
    items.vector("eye", scene.eye);
    items.vector("look at", scene.target);
    items.vector("up", scene.up);
}

void flight_items(Motion& motion)
{
    const double slow = 1.0 / 16;
    const double fast = 16;
    ImGui::SliderScalar("speed", ImGuiDataType_Double, &motion.speed, &slow, &fast, "%.2f distances/s",
                        ImGuiSliderFlags_Logarithmic);
    ImGui::Checkbox("walls stop the flight", &motion.collides);
}

void device_list(Model& model)
{
    const Setup now = model.view.setup();
    if (!ImGui::BeginCombo("backend", fmt::format("{}:{}", now.backend, now.device).c_str(),
                           ImGuiComboFlags_HeightLarge)) {
        return;
    }
    const auto& listings = model.listings();
    std::size_t at = 0;
    for (const auto& backend : model.registry.backends()) {
        const Listing listing = at < listings.size() ? listings[at] : Listing{{{"", "", "", false}}, "", ""};
        ++at;
        for (std::size_t i = 0; i < listing.devices.size(); ++i) {
            const Setup setup = with_device(now, *backend, static_cast<int>(i));
            const std::string name = fmt::format("{}:{} {}", backend->name(), i, listing.devices[i].name);
            const bool is = now.backend == setup.backend && now.device == setup.device;
            if (ImGui::Selectable(name.c_str(), is)) model.change(setup);
        }
        const std::string& why = listing.failure.empty() ? listing.unavailable : listing.failure;
        if (!why.empty()) ImGui::TextDisabled("%s: %s", std::string(backend->name()).c_str(), why.c_str());
    }
    ImGui::EndCombo();
}

// Shows two radio buttons. `other`: the setup to use if the user chooses the button that is off.
void two_choices(Model& model, const char* first, const char* second, bool is_first, const Setup& other)
{
    if (ImGui::RadioButton(first, is_first) && !is_first) model.change(other);
    ImGui::SameLine();
    if (ImGui::RadioButton(second, !is_first) && is_first) model.change(other);
}

void setup_items(Model& model)
{
    ShownView& view = model.view;
    int count = static_cast<int>(view.setups().size());
    if (ImGui::SliderInt("side by side", &count, 1, most_panes)) {
        view.remember();
        view.set_count(static_cast<std::size_t>(std::clamp(count, 1, most_panes)));
    }
    if (view.setups().size() > 1) {
        int chosen = static_cast<int>(view.chosen()) + 1;
        if (ImGui::SliderInt("pane", &chosen, 1, count)) view.choose(static_cast<std::size_t>(std::max(1, chosen)) - 1);
        if (ImGui::Checkbox("mark differing pixels", &model.marks)) view.changed();
    }
    device_list(model);
    const Setup now = view.setup();
    two_choices(model, "float", "double", now.precision == Precision::f32, with_other_precision(now));
    two_choices(model, "fast", "exact", now.mode == Mode::fast, with_other_mode(now));
}

// Shows a field for an integer, with buttons that change it.
void number_field(const char* name, int& value, int low, int high)
{
    ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
    ImGui::InputInt(name, &value);
    value = std::clamp(value, low, high);
}

// A button that performs an action. Without a label, it shows the action's name.
struct Button {
    std::string action;
    std::string label{};
};

void show_buttons(Model& model, std::initializer_list<Button> row)
{
    for (const Button& button : row) {
        if (&button != row.begin()) ImGui::SameLine();
        std::string label = button.label.empty() ? button.action : button.label;
        std::ranges::replace(label, '-', ' ');
        if (ImGui::Button(label.c_str())) action_named(button.action)->perform(model);
    }
}

}  // namespace

float panel_width(int window_width)
{
    // The width follows from the font's nominal size, because the size that ImGui returns is 0 before the first frame.
    const float letter = 13 * ImGui::GetIO().FontGlobalScale;
    return std::round(std::min(width_in_letters * letter * 0.6F, most_of_window * static_cast<float>(window_width)));
}

void show_panel(Model& model, float width, bool focus)
{
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({width, ImGui::GetIO().DisplaySize.y});
    if (focus) ImGui::SetNextWindowFocus();
    ImGui::Begin("panel", nullptr,
                 (ImGuiWindowFlags_NoDecoration & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushItemWidth(ImGui::GetWindowWidth() * 0.55F);
    ImGui::TextDisabled("F1 help, F2 hides this, Esc: keys work here");
    if (ImGui::CollapsingHeader("backend and mode", ImGuiTreeNodeFlags_DefaultOpen)) setup_items(model);
    if (ImGui::CollapsingHeader("view", ImGuiTreeNodeFlags_DefaultOpen)) {
        scene_items(model);
        flight_items(model.motion);
        show_buttons(model, {{"reset-view"}, {"undo"}, {"redo"}});
    }
    show_buttons(model, {{"save-view"}, {"save-place"}});
    ImGui::Checkbox("paths", &model.paths);
    ImGui::SameLine();
    ImGui::Checkbox("statistics", &model.settings.statistics);
    float scale = static_cast<float>(model.settings.scale);
    if (ImGui::SliderFloat("text size", &scale, 0.5F, 4.0F, "%.1f")) {
        model.settings.scale = static_cast<double>(scale);
        ImGui::GetIO().FontGlobalScale = scale;
    }
    ImGui::PopItemWidth();
    ImGui::End();
}

void show_paths(Model& model, float left)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float wanted = 26 * ImGui::GetFontSize();
    left = std::max({0.0F, left, size.x - wanted});
    const float width = size.x - left;
    // This panel covers the other one if there is not enough room next to it.
    const bool beside = width > 12 * ImGui::GetFontSize();
    ImGui::SetNextWindowPos({beside ? left : 0, 0.0F});
    const float used = beside ? width : size.x;
    ImGui::SetNextWindowSize({used, 0});  // as high as its items
    ImGui::SetNextWindowSizeConstraints({used, 0}, {used, size.y * 0.7F});
    ImGui::Begin("paths", &model.paths,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    PathEditor& path_editor = model.path_editor;
    show_buttons(model, {{"record", path_editor.recording() ? "end recording" : "record"}});
    ImGui::SameLine();
    ImGui::Text("%zu frames, %.1f s", path_editor.frames(),
                static_cast<double>(path_editor.frames()) / path_editor.path().frames_per_second);
    if (path_editor.has_path() && !path_editor.recording()) {
        float at = static_cast<float>(path_editor.at());
        ImGui::SetNextItemWidth(-1);
        if (ImGui::SliderFloat("##at", &at, 0, static_cast<float>(path_editor.frames() - 1), "frame %.0f")) {
            path_editor.go_to(static_cast<double>(at));
            model.show_path();
        }
        show_buttons(model, {{"play-or-stop", path_editor.playing ? "stop" : "play"}, {"smooth"}});
        number_field("width", model.film_width, 16, max_side);
        ImGui::SameLine();
        number_field("height", model.film_height, 16, max_side);
        show_buttons(model, {{"save-path"}, {"film"}});
    }
    number_field("seed", model.tour_seed, 0, std::numeric_limits<int>::max());
    ImGui::SameLine();
    number_field("frames", model.tour_frames, 60, 100'000);
    if (!path_editor.planning()) show_buttons(model, {{"plan-a-tour"}});
    ImGui::End();
}

}  // namespace mandelmarch::explore
