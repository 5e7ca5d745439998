// SPDX-License-Identifier: Apache-2.0
// The text that is drawn over the pictures, and the help.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "apps/explore/view/panels.h"
#include "apps/survey.h"

namespace mandelmarch::explore {
namespace {

constexpr ImU32 text_colour = IM_COL32(255, 255, 255, 255);
constexpr ImU32 warning_colour = IM_COL32(255, 190, 90, 255);
constexpr ImU32 ground_colour = IM_COL32(0, 0, 0, 170);
constexpr ImU32 edge_colour = IM_COL32(90, 160, 255, 255);
constexpr float margin = 4;  // pixels

// A column of lines of text, at most `width` pixels wide.
struct Column {
    float x, y, width;  // pixels; x: left edge; y: upper edge of the next line or, upwards, its lower edge

    // Adds a line below y or, if `upwards`, above y. An empty text adds nothing.
    void add(const std::string& text, ImU32 colour, bool upwards = false)
    {
        if (text.empty()) return;
        const float wrap = std::max(40.0F, width - 2 * margin);
        const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
        const float height = size.y + 2 * margin;
        if (upwards) y -= height;
        ImDrawList& list = *ImGui::GetBackgroundDrawList();
        list.AddRectFilled({x, y}, {x + size.x + 2 * margin, y + height}, ground_colour);
        list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x + margin, y + margin}, colour, text.c_str(), nullptr,
                     wrap);
        if (!upwards) y += height;
    }
};

std::string statistics_of(const Pane& pane)
{
    if (pane.seconds == 0) return name_of(pane.setup) + (pane.failure.empty() ? ": drawing" : "");
    std::string text = fmt::format("{}: {:.1f} ms", name_of(pane.setup), 1e3 * pane.seconds);
    if (pane.samples == 0) {
        text += fmt::format(", {:.0f} % of the pixels", 100 * pane.share);
    } else {
        text += fmt::format(", {} sample{} per pixel", pane.samples * pane.samples, pane.samples > 1 ? "s" : "");
    }
    if (!pane.report.instruction_set.empty()) text += fmt::format(", {}", pane.report.instruction_set);
    if (pane.compared) {
        text +=
            fmt::format("; {} pixels differ, {} visibly", pane.compared->differing, pane.compared->visibly_differing);
    }
    return text;
}

}  // namespace

void show_overlay(const Model& model, const Panes& panes, const SDL_Rect& area, double clearance)
{
    const ShownView& view = model.view;
    for (std::size_t i = 0; i < panes.all().size(); ++i) {
        const Pane& pane = panes.all()[i];
        const SDL_Rect place = panes.place(i);
        Column column{static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.w)};
        if (panes.all().size() > 1 && i == view.chosen()) {
            ImGui::GetBackgroundDrawList()->AddRect(
                {column.x, column.y}, {column.x + column.width, static_cast<float>(place.y + place.h)}, edge_colour);
        }
        if (model.settings.statistics) column.add(statistics_of(pane), text_colour);
        column.add(pane.failure, warning_colour);
        const bool at_rest = pane.whole.pixels() > 0 && pane.whole_view == pane.view;
        column.add(view_warning(view.scene(), clearance, pane.setup.precision, at_rest && has_one_colour(pane.whole)),
                   warning_colour);
    }
    Column column{static_cast<float>(area.x), ImGui::GetIO().DisplaySize.y, static_cast<float>(area.w)};
    if (model.settings.statistics) {
        column.add(fmt::format("W A S D fly, drag to turn, F1 help; distance {:.3g}, {:.0f} frames per second",
                               clearance, static_cast<double>(ImGui::GetIO().Framerate)),
                   text_colour, true);
    }
    column.add(model.said(), text_colour, true);
    column.add(panes.trouble(), warning_colour, true);
    const PathEditor& path_editor = model.path_editor;
    if (path_editor.recording())
        column.add(fmt::format("recording, {} frames", path_editor.frames()), warning_colour, true);
    if (path_editor.planning()) column.add("planning a tour", text_colour, true);
    if (path_editor.filming())
        column.add(fmt::format("filming: {:.0f} %", 100 * path_editor.filmed()), text_colour, true);
}

void show_help(Model& model)
{
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("help", &model.help,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextWrapped(
        "W S: forwards and back; A D: sideways; R F: up and down; Q E: roll; arrow keys or dragging: turn; wheel: "
        "speed, which is proportional to the distance to the surface. Game pad: the left stick and the triggers move; "
        "the right stick and the shoulder buttons turn.");
    ImGui::Columns(2, nullptr, false);
    ImGui::SetColumnWidth(0, 9 * ImGui::GetFontSize());
    for (const Action& action : actions()) {
        if (action.key.empty()) continue;
        ImGui::TextUnformatted(action.key.data(), action.key.data() + action.key.size());
        ImGui::NextColumn();
        ImGui::TextWrapped("%s", action.help);
        ImGui::NextColumn();
    }
    ImGui::Columns(1);
    ImGui::TextWrapped("%s", fmt::format("Files go to {}; settings are in {}.",
                                         model.folder.empty() ? "." : model.folder, settings_file())
                                 .c_str());
    ImGui::End();
}

}  // namespace mandelmarch::explore
